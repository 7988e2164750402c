/// @file
/// What a skin's mixture knows of all that presses, at any level: of a line
/// `resultant_distributions`.
///
///     const lab::FrameAnswer answer = lab::solve(problem, readings);
///     if (answer.mixture)
///       lab::wrench_distributions(*answer.mixture, problem).normal.interval(0.5);
#pragma once

#include <optional>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/load_mixture.hpp"
#include "tactile_net/numeric/distribution.hpp"

namespace tactile_net::lab {

/// Of the sums over all cells.
struct WrenchDistributions {
  Distribution normal{};                                       ///< [N]
  std::optional<Distribution> tangential_y{}, tangential_z{};  ///< [N]; absent with one component
  /// Of the force's place [m]; absent where the normal force is less than five deviations away
  /// from 0.
  std::optional<Distribution> centre_y{}, centre_z{};
};

class SkinSceneProblem;

/// As the answer's intervals have them. @param problem  whose answer has the mixture
[[nodiscard]] WrenchDistributions wrench_distributions(const LoadMixture& mixture,
                                                       const SkinSceneProblem& problem);
/// As the mixture's model alone has them. @param problem  that the mixture is of, of a skin
[[nodiscard]] WrenchDistributions wrench_distributions(const LoadMixture& mixture,
                                                       const LinearProblem& problem);

}  // namespace tactile_net::lab
