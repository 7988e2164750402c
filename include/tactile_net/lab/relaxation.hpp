/// @file
/// A scene's circuit: its deck, its certificate, and what the simulator makes of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace tactile_net::lab {

/// A circuit for one frame of readings, ready to be written.
struct CircuitPlan {
  NetworkOptions options;
  NetworkProblem problem;
  Circuit circuit;
  DeckHeader header;
  std::vector<double> direct;  ///< f of the direct solve of P f = b [Pa]
};

[[nodiscard]] CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings,
                                       double alpha);

/// With the scene's alpha, or the one its rule chooses for these readings.
[[nodiscard]] CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings);

/// The deck of the operating point, or of the one frequency of `lc`.
[[nodiscard]] std::string deck_text(const CircuitPlan& plan, Answer answer);

[[nodiscard]] Certificate certify(const CircuitPlan& plan);

/// Tolerances, and some of their draws in the simulator.
struct ToleranceStudy {
  ToleranceOptions options;
  ToleranceResult result;
  std::size_t replayed = 0;
  double difference = 0.0;  ///< largest |v_simulator - v|_2 / |v|_2 of those draws
};

/// The answer of the circuit beside that of the direct solve.
struct Relaxation {
  Realization realization = Realization::ideal;
  std::size_t nodes = 0;
  ElementCounts elements{};
  std::vector<double> voltages{};     ///< [V]
  std::vector<double> tractions{};    ///< voltages / volts [Pa]
  double difference = 0.0;            ///< |v - f|_2 / |f|_2
  double limit = 0.0;                 ///< largest difference that rounding explains
  double curves = 0.0;                ///< largest that the devices' curves explain
  std::optional<double> predicted{};  ///< the difference that the op-amps' gain and offset make
  double smallest_eigenvalue = 0.0;   ///< of P
  double condition =
      0.0;              ///< bound on P's condition number: largest row sum / that; may be infinite
  bool stable = false;  ///< by the certificate if there is one, otherwise: P is definite
  double ngspice_seconds = 0.0;
  std::optional<Certificate> certificate{};   ///< where op-amps, parasitics or tolerances are given
  std::optional<Judged> judged{};             ///< where settling is asked for
  std::optional<ToleranceStudy> tolerance{};  ///< where a tolerance is given
  std::vector<std::string> warnings{};

  /// The difference is what rounding and the op-amps explain: within a fifth of the prediction.
  [[nodiscard]] bool agrees() const noexcept;
  /// The simulator's transient says what the certificate says, where both speak.
  [[nodiscard]] bool judged_as_certified() const noexcept;
  /// Whether rounding leaves enough digits for the comparison, and the circuit, to mean something.
  [[nodiscard]] bool resolved() const noexcept { return limit <= 1e-3; }
  /// Why this is no answer that holds; empty if it is.
  [[nodiscard]] std::string failure() const;
};

/// Runs the simulator: the operating point always, transients where settling is asked for, draws
/// of components where a tolerance is given. @throw SimulatorError
[[nodiscard]] Relaxation relax(const CircuitPlan& plan, Simulator& simulator,
                               Observer& observer = silent);

/// The plan's tolerances; parts of 1 % where it has none.
[[nodiscard]] ToleranceOptions drawn_options(const CircuitPlan& plan);

/// What the draws of a plan's tolerances do. @pre plan.options.tolerance
[[nodiscard]] ToleranceResult tolerate(const CircuitPlan& plan);

/// Which realisation for these tolerances, and why: from 200 draws of each.
struct Recommendation {
  struct Candidate {
    Realization realization = Realization::nic;
    std::size_t opamps = 0;
    ToleranceResult tolerance{};
  };
  std::vector<Candidate> candidates{};
  std::string text{};
};
[[nodiscard]] Recommendation recommend(const CircuitPlan& plan);

}  // namespace tactile_net::lab
