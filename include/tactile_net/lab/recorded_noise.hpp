/// @file
/// The noise of a recording, for a scene that does not state it.
#pragma once

#include <optional>

#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {

/// Whether alpha and bands wait for the noise's rms: the scene states neither noise nor alpha nor a
/// rule, its array is too coarse to tell noise from signal by a single frame, and the method has
/// bands.
[[nodiscard]] bool wants_noise(const SceneProblem& problem, Method method);

/// The problem with the noise that still frames show, of several quantities one rms for each; the
/// same one where too few are still, or some quantity shows no noise at all.
///
/// @param check  of its recording
[[nodiscard]] SceneProblem with_recorded_noise(const SceneProblem& problem,
                                               const ReadingsCheck& check);

/// What is to be said of a problem whose noise was taken so; absent where it was not.
[[nodiscard]] std::optional<Finding> noise_taken(const SceneProblem& stated,
                                                 const SceneProblem& solved);

}  // namespace tactile_net::lab
