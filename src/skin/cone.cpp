#include "tactile_net/skin/cone.hpp"

#include <stdexcept>
#include <utility>

#include "skin/cone_search.hpp"

namespace tactile_net {

double constrained_alpha(AlphaRule rule, double alpha) noexcept {
  return rule == AlphaRule::rgcv || rule == AlphaRule::aicc ? 0.5 * alpha : alpha;
}

Matrix edges(const LinearProblem& problem, const ActiveFace& face) {
  const std::size_t cells = problem.grid.count();
  Matrix map{problem.components * cells, face.free.size(),
             std::vector<double>(problem.components * cells * face.free.size())};
  for (std::size_t j = 0; j < face.free.size(); ++j) {
    const auto& [cell, along] = face.free[j];
    if (cell >= cells) throw std::invalid_argument("a face of another problem");
    for (std::size_t u = 0; u < problem.components; ++u) map(u * cells + cell, j) = along[u];
  }
  return map;
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
