/// @file
/// Parts of a scene's problem, each made anew: `SceneProblem` makes them once.
#pragma once

#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {

[[nodiscard]] inline ProblemOptions problem_options(const Scene& scene) {
  return SceneProblem(scene).options();
}
[[nodiscard]] inline InverseProblem problem_of(const Scene& scene) {
  return SceneProblem(scene).problem();
}
[[nodiscard]] inline std::optional<double> stated_noise(const Scene& scene) {
  return SceneProblem(scene).stated_noise();
}
[[nodiscard]] inline std::optional<Constraints> constraints_of(const Scene& scene) {
  return SceneProblem(scene).constraints();
}
[[nodiscard]] inline AlphaSweep sweep_of(const Scene& scene, std::span<const double> readings) {
  return SceneFrame(SceneProblem(scene), readings).sweep();
}

}  // namespace tactile_net::lab
