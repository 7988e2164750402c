/// @file
/// A refinement through the simulator: a deck a cycle, beside the same build in numbers.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/refinement.hpp"
#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::lab {

/// What to do where builds are not stable.
inline constexpr std::string_view steadier_builds =
    "take better parts, a larger alpha, or lattice or least_squares, which never form P";

/// The first build that `certify --refine` draws.
struct SimulatedRefinement {
  RefinementOptions options{};
  ToleranceOptions drawn{};  ///< what its resistors are off

  struct Cycle {
    double numbers = 0.0;    ///< |f - f*|_2 / |f*|_2 after the cycle, in numbers
    double simulated = 0.0;  ///< the same with the simulator's answers
    /// Of the simulator's answer from the numbers' to the same currents, relative: what P^ leaves
    /// out, such as common-mode rejection, and rounding.
    double difference = 0.0;
  };
  std::vector<Cycle> cycles{};  ///< empty: the build is not stable
  double simulator_seconds = 0.0;

  /// After each cycle the simulator is within three times of the numbers, or they of it.
  [[nodiscard]] bool agrees() const noexcept;
};

/// @pre  the scene asks for it, `NetworkOptions::refine`
/// @throw std::invalid_argument  as `Refinement`
/// @throw SimulatorError
[[nodiscard]] SimulatedRefinement refine(const SceneCircuit& circuit, Simulator& simulator,
                                         Observer& observer = silent);

/// The circuit of that build as it answers in a cycle.
struct RefinementDeck {
  Circuit circuit{};
  std::size_t cycle = 1;
  double size = 1.0;               ///< how many times as large as r its currents are
  std::vector<double> expected{};  ///< voltages of its outputs at rest [V]
  double error = 0.0;              ///< |f - f*|_2 / |f*|_2 before the cycle; 0: it is the first
};

/// @param cycle  1: the readings; from 2 on: what is left after those before
/// @pre  as `refine`
/// @throw std::invalid_argument  as `Refinement`; there is no such cycle; the build is not stable
[[nodiscard]] RefinementDeck refinement_deck(const SceneCircuit& circuit, std::size_t cycle);

}  // namespace tactile_net::lab
