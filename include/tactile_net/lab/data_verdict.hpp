/// @file
/// Whether a scene's frame can be true, whatever the method: one rule for every command.
///
///     result.data = lab::data_verdict(problem, readings, f);
#pragma once

#include <optional>
#include <span>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::lab {

/// By the noise, the friction limit and the stiffness that the scene states; the
/// array's ends are its outer quarters and what lies beyond.
[[nodiscard]] DataLimits data_limits(const SceneProblem& problem);

/// Contacts are sought on a grid of a quarter of the least depth at most, to two depths beyond the
/// array's ends; where that would have very many values, or the noise is not known, on the
/// tractions' own.
[[nodiscard]] DataJudge data_judge(const SceneProblem& problem);

/// Nothing of a large array, which is solved without a matrix.
///
/// @param problem    that the frame was solved with
/// @param tractions  that a method found [Pa]
/// @param memory     of frames of the same problem
[[nodiscard]] std::optional<DataVerdict> data_verdict(const SceneProblem& problem,
                                                      std::span<const double> readings,
                                                      std::span<const double> tractions,
                                                      DataMemory* memory = nullptr);

/// What is to be said of a frame whose data are doubted, with the scene's names and units.
/// @param data  not consistent
[[nodiscard]] remark::DataDoubted data_doubted(const DataVerdict& data, const Scene& scene);
[[nodiscard]] remark::DataDoubted data_doubted(const DataVerdict& data, const SkinScene& scene);

/// Adds what frames before have shown of a taxel (repeating_taxels.hpp).
void doubt(DataVerdict& data, std::optional<std::size_t> bad_taxel);

}  // namespace tactile_net::lab
