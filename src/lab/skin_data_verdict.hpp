/// @file
/// Whether a skin's frame can be true, as lab/data_verdict.hpp has it for lines. Private.
///
///     answer.data = problem.data_judge().judge(readings, answer.tractions);
#pragma once

#include <span>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::lab {

/// By the noise, the friction limit and the stiffness that the scene states: no stress above
/// Young's modulus, no strain above 1, no displacement beyond the taxel's depth.
[[nodiscard]] DataLimits data_limits(const SkinSceneProblem& problem);

/// What a contact must explain: the readings, less the constant that was found in each channel
/// where offsets are not known. How large that is says nothing of what presses.
///
/// @param tractions  that a method found [Pa]
[[nodiscard]] std::vector<double> without_offsets(const SkinSceneProblem& problem,
                                                  std::span<const double> readings,
                                                  std::span<const double> tractions);

/// The force of a pad that the frame's largest strain presses all over [N]: no deviation of a force
/// that the readings fix is as large.
/// @param readings  as `without_offsets`
[[nodiscard]] double largest_force(const SkinSceneProblem& problem,
                                   std::span<const double> readings);

/// Contacts are sought on a grid of a quarter of the least depth, to two depths beyond the
/// outermost taxels; where that would have very many cells, or the noise is not known, on the
/// tractions' own.
[[nodiscard]] DataJudge data_judge(const SkinSceneProblem& problem);

}  // namespace tactile_net::lab
