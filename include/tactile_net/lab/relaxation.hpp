/// @file
/// What the simulator makes of a scene's circuit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/verdict.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace tactile_net::lab {

/// Tolerances, and some of their draws in the simulator.
struct ToleranceStudy {
  ToleranceOptions options;
  ToleranceResult result;
  std::size_t replayed = 0;
  double difference = 0.0;  ///< largest |v_simulator - v|_2 / |v|_2 of those draws
};

/// Why the circuit's answer does not hold.
struct Disagreement {
  enum class Kind {
    curves,        ///< the devices' curves may change the answer by `value` of itself
    difference,    ///< `value` off the direct solve, more than `explained` bears
    transient,     ///< the certificate's slowest pole is `value` [1/s], the transient ended `seen`
    not_definite,  ///< P: the circuit would not settle
    unstable,      ///< the slowest pole is at `value` [1/s]
    draws,         ///< draws of components differ by `value` in the simulator
  };
  Kind kind = Kind::difference;
  double value = 0.0;
  ExplainedDifference explained{};
  TransientEnd seen = TransientEnd::unsettled;

  bool operator==(const Disagreement&) const = default;
};

/// What is worth knowing of a relaxation beside its numbers and its certificate's remarks.
struct RelaxationRemark {
  enum class Kind {
    no_load,                ///< nothing to settle to, and nothing for components to change
    inaccurate,             ///< `value` off the direct solve, relative, though its parts explain it
    stability_not_known,    ///< the certificate says why
    draws_without_opamps,   ///< draws leave out the op-amps' dynamics, not known to be stable here
    settles_otherwise,      ///< ngspice's settling time over the certificate's, less 1, is `value`
    nothing_takes_time,     ///< settling is asked for; neither op-amps nor nodes are slow
    tolerances_not_linear,  ///< tolerances are studied for networks of resistors and op-amps
  };
  Kind kind = Kind::no_load;
  double value = 0.0;
};

/// The answer of the circuit beside that of the direct solve.
struct Relaxation {
  Realization realization = Realization::ideal;
  std::size_t nodes = 0;
  ElementCounts elements{};
  std::vector<std::string> names{};  ///< of the nodes
  std::vector<double> voltages{};    ///< [V]
  std::vector<double> tractions{};   ///< voltages / volts [Pa]
  double difference = 0.0;           ///< |v - f|_2 / |f|_2
  ExplainedDifference explained{};   ///< what may make that difference
  double smallest_eigenvalue = 0.0;  ///< of P
  Condition condition{};             ///< of P, a bound
  /// Known to be: by the certificate if there is one, otherwise since P is definite.
  bool stable = false;
  double ngspice_seconds = 0.0;
  std::optional<Certificate> certificate{};   ///< where op-amps, parasitics or tolerances are given
  std::optional<Transient> transient{};       ///< where settling is asked for
  std::optional<ToleranceStudy> tolerance{};  ///< where a tolerance is given
  std::vector<RelaxationRemark> remarks{};

  /// The difference is what rounding and the op-amps explain: within a fifth of the prediction.
  [[nodiscard]] bool agrees() const noexcept;
  /// The simulator's transient says what the certificate says, where both speak.
  [[nodiscard]] bool transient_as_certified() const noexcept;
  /// Whether rounding leaves enough digits for the comparison, and the circuit, to mean something.
  [[nodiscard]] bool resolved() const noexcept { return explained.limit <= 1e-3; }
  /// Why this is no answer that holds; absent if it is.
  [[nodiscard]] std::optional<Disagreement> disagreement() const noexcept;
  /// Failed where it disagrees; else whether the answer is one to use.
  [[nodiscard]] Verdict verdict() const noexcept;
};

/// Runs the simulator: the operating point always, transients where settling is asked for, draws
/// of components where a tolerance is given. @throw SimulatorError
[[nodiscard]] Relaxation relax(const SceneCircuit& circuit, Simulator& simulator,
                               Observer& observer = silent);

}  // namespace tactile_net::lab
