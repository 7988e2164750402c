/// @file
/// A scene's circuit with the readings that the scene itself makes, noise included.
#pragma once

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/simulated_frame.hpp"

namespace tactile_net {

inline lab::SceneCircuit circuit_of(const Scene& scene) {
  return lab::SceneCircuit(
      lab::SceneFrame(lab::SceneProblem(scene), lab::simulate(scene).readings));
}

}  // namespace tactile_net
