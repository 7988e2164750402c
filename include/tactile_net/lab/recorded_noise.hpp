/// @file
/// The noise of a recording, for a scene that does not state it.
#pragma once

#include <optional>

#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/sensing/effects/noise.hpp"

namespace tactile_net::lab {

/// Whether alpha and bands wait for the noise's rms: the scene states neither noise nor alpha nor a
/// rule, and its array is too coarse to tell noise from signal by a single frame.
[[nodiscard]] bool wants_noise(const SceneProblem& problem);

/// What still frames leave, of several quantities one rms for each; absent: too few are still, or
/// some quantity shows no noise at all.
///
/// @param check  of the recording, by the scene without noise
[[nodiscard]] std::optional<NoiseModel> recorded_noise(const ReadingsCheck& check);

/// What is to be said of a scene whose noise was taken so.
[[nodiscard]] Finding noise_taken(const Scene& scene);

}  // namespace tactile_net::lab
