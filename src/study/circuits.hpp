/// @file
/// Private. What is simulated of circuits, one file each; an exception fails the whole job.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::study {

/// Asked between steps, true ends the work with what there is.
using Stop = std::function<bool()>;

/// The study's scene with that circuit, its op-amps of that bandwidth [Hz]; without: as the scene
/// has them. Without constraints, which no circuit holds; of a skin on cells as wide as the pitch
/// where its own make too many nodes.
[[nodiscard]] AnyScene with_circuit(const StudyInput& input, Realization realization,
                                    std::optional<double> bandwidth = {});

/// That scene's circuit for the study's frame and alpha.
[[nodiscard]] lab::SceneCircuit circuit_of(const StudyInput& input, const AnyScene& scene);

/// The scene's options for circuits.
[[nodiscard]] NetworkOptions& network_of(AnyScene& scene);

/// The curve of such a circuit.
[[nodiscard]] WorkCurve curve_of(const StudyInput& input, const AnyScene& scene,
                                 std::optional<double> bandwidth = {});

/// More resistors than this take the simulator minutes.
inline constexpr std::size_t most_simulated_resistors = 40000;
/// Whether parts are drawn for a circuit, and the simulator asked: not for skins of more than
/// `most_drawn_amplifiers` nodes and residuals, of which either takes minutes.
[[nodiscard]] bool is_small(const AnyScene& scene);
inline constexpr std::size_t most_drawn_amplifiers = 200;
/// What is left out of a circuit that is not, and why.
[[nodiscard]] std::string why_not_drawn(const AnyScene& scene);

/// One realisation's step response at every bandwidth.
[[nodiscard]] StudySection settling(const StudyInput& input, Realization realization,
                                    Simulator& simulator, const Stop& stop);

/// The thesis' own network: resistors, some negative, and the capacitance of its nodes.
[[nodiscard]] StudySection passive_settling(const StudyInput& input, Simulator& simulator,
                                            const Stop& stop);

/// How long two arrays of op-amps of 10 MHz take to settle to one percent, on skins of fewer and of
/// more taxels, by their poles. @pre  the skin is even
[[nodiscard]] StudySection circuit_sizes(const StudyInput& input, const Stop& stop);

/// What the simulator takes for the operating point, and how well it agrees.
[[nodiscard]] StudySection operating_points(const StudyInput& input, Simulator& simulator);

/// How those circuits, their op-amps of 10 MHz, and loops follow the frame's contacts along y.
/// Nothing without a contact; of circuits those that settle.
[[nodiscard]] StudySection moving_contacts(const StudyInput& input,
                                           std::span<const Realization> circuits, const Stop& stop);

/// What components of 1 % and 0.1 % do to each circuit.
[[nodiscard]] StudySection parts_floors(const StudyInput& input, const Stop& stop);

}  // namespace tactile_net::study
