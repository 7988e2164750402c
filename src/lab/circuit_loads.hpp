/// @file
/// The loads that a circuit's parts are chosen for. Private.
#pragma once

#include <memory>
#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/soldered_error.hpp"

namespace tactile_net::lab {

/// The circuit's own problem, and the same one with the scene's contacts moved along the sensor, by
/// an eighth and a quarter of its length either way: equal but for the readings.
[[nodiscard]] std::vector<std::shared_ptr<const NetworkProblem>> circuit_loads(
    const SceneCircuit& circuit);

/// A circuit's sources under each of them.
[[nodiscard]] std::vector<Load> loads_of(
    const NetworkCircuit& circuit,
    const std::vector<std::shared_ptr<const NetworkProblem>>& problems);

}  // namespace tactile_net::lab
