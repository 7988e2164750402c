/// @file
/// A scene's circuit: its deck, and what ngspice makes of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tactile_net/inverse/problem.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::tool {

/// A circuit for one frame of readings, ready to be written.
struct CircuitPlan {
  Realization realization = Realization::ideal;
  Scale scale;
  Matrix matrix;  ///< P
  Circuit circuit;
  DeckHeader header;
  std::vector<double> direct;  ///< f of the direct solve of P f = b [Pa]
};

[[nodiscard]] CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings,
                                       double alpha);

/// With the scene's alpha, or the one its rule chooses for these readings.
[[nodiscard]] CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings);

[[nodiscard]] std::string deck_text(const CircuitPlan& plan, Answer answer);

/// The answer of the circuit beside that of the direct solve.
struct Relaxation {
  Realization realization = Realization::ideal;
  std::size_t nodes = 0;
  ElementCounts elements{};
  std::vector<double> voltages{};    ///< [V]
  std::vector<double> tractions{};   ///< voltages / volts [Pa]
  double difference = 0.0;           ///< |v - f|_2 / |f|_2
  double limit = 0.0;                ///< largest difference that rounding explains
  double smallest_eigenvalue = 0.0;  ///< of P
  double condition =
      0.0;              ///< bound on P's condition number: largest row sum / that; may be infinite
  bool stable = false;  ///< P is positive definite
  double ngspice_seconds = 0.0;

  [[nodiscard]] bool agrees() const noexcept { return stable && difference <= limit; }
  /// Whether rounding leaves enough digits for the comparison, and the circuit, to mean something.
  [[nodiscard]] bool resolved() const noexcept { return limit <= 1e-3; }
};

/// Runs the simulator. @throw SimulatorError
[[nodiscard]] Relaxation relax(const CircuitPlan& plan, Simulator& simulator);

}  // namespace tactile_net::tool
