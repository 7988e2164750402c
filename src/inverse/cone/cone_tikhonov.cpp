#include "tactile_net/inverse/cone_tikhonov.hpp"

#include <utility>

#include "inverse/cone/cone_search.hpp"

namespace tactile_net {

double constrained_alpha(AlphaRule rule, double alpha) noexcept {
  return rule == AlphaRule::rgcv || rule == AlphaRule::aicc ? 0.5 * alpha : alpha;
}

struct ConeTikhonov::System {
  ConeSearch search;
};

ConeTikhonov::ConeTikhonov(const LinearProblem& problem, double alpha,
                           const Constraints& constraints)
    : system_(std::make_unique<const System>(System{{problem, alpha, constraints}})) {}
ConeTikhonov::ConeTikhonov(std::unique_ptr<const System> system) : system_(std::move(system)) {}
ConeTikhonov::~ConeTikhonov() = default;
ConeTikhonov::ConeTikhonov(ConeTikhonov&&) noexcept = default;
ConeTikhonov& ConeTikhonov::operator=(ConeTikhonov&&) noexcept = default;

ConeTikhonov ConeTikhonov::with_alpha(double alpha) const {
  return ConeTikhonov(std::make_unique<const System>(System{system_->search.with_alpha(alpha)}));
}

ConeSolution ConeTikhonov::solve(std::span<const double> readings, std::size_t iteration_limit,
                                 double enough, const EarlyStop& stop_early) const {
  return system_->search.solve(readings, iteration_limit, enough, stop_early);
}

}  // namespace tactile_net
