/// @file
/// Private. What is simulated of circuits, one file each; an exception fails the whole job.
#pragma once

#include <functional>
#include <optional>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::study {

/// Asked between steps, true ends the work with what there is.
using Stop = std::function<bool()>;

/// The study's scene with that circuit, its op-amps of that bandwidth [Hz]; without: as the scene
/// has them.
[[nodiscard]] Scene with_circuit(const StudyInput& input, Realization realization,
                                 std::optional<double> bandwidth = {});

/// That scene's circuit for the study's frame and alpha.
[[nodiscard]] inline lab::SceneCircuit circuit_of(const StudyInput& input, const Scene& scene) {
  return {lab::SceneFrame(lab::SceneProblem(scene), input.readings), {.value = input.alpha}};
}

/// One realisation's step response at every bandwidth.
[[nodiscard]] StudySection settling(const StudyInput& input, Realization realization,
                                    Simulator& simulator, const Stop& stop);

/// The thesis' own network: resistors, some negative, and the capacitance of its nodes.
[[nodiscard]] StudySection passive_settling(const StudyInput& input, Simulator& simulator,
                                            const Stop& stop);

/// What the simulator takes for the operating point, and how well it agrees.
[[nodiscard]] StudySection operating_points(const StudyInput& input, Simulator& simulator);

/// What components of 1 % and 0.1 % do to each circuit.
[[nodiscard]] StudySection parts_floors(const StudyInput& input, const Stop& stop);

}  // namespace tactile_net::study
