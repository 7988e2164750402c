#include "tactile_net/skin/cone.hpp"

#include <utility>

#include "skin/cone_search.hpp"

namespace tactile_net {

double constrained_alpha(AlphaRule rule, double alpha) noexcept {
  return rule == AlphaRule::rgcv || rule == AlphaRule::aicc ? 0.5 * alpha : alpha;
}

struct SkinCone::System {
  ConeSearch search;
};

SkinCone::SkinCone(const LinearProblem& problem, double alpha, const Constraints& constraints)
    : system_(std::make_unique<const System>(System{{problem, alpha, constraints}})) {}
SkinCone::SkinCone(std::unique_ptr<const System> system) : system_(std::move(system)) {}
SkinCone::~SkinCone() = default;
SkinCone::SkinCone(SkinCone&&) noexcept = default;
SkinCone& SkinCone::operator=(SkinCone&&) noexcept = default;

SkinCone SkinCone::with_alpha(double alpha) const {
  return SkinCone(std::make_unique<const System>(System{system_->search.with_alpha(alpha)}));
}

SkinConeSolution SkinCone::solve(std::span<const double> readings, std::size_t iteration_limit,
                                 double enough) const {
  return system_->search.solve(readings, iteration_limit, enough);
}

}  // namespace tactile_net
