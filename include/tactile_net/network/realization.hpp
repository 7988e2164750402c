/// @file
/// The ways to build a network, by name.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/conductances.hpp"
#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

enum class Realization { ideal, nic, rail, crossbar, least_squares, lattice, lc, ndr };

template <>
struct Enumerators<Realization> {
  static constexpr Enumerator<Realization> all[] = {
      {Realization::ideal, "ideal",
       "Resistors, negative ones included: the definition, for checking."},
      {Realization::nic, "nic",
       "A floating negative impedance converter for each negative branch (thesis 5.2, ii)."},
      {Realization::rail, "rail", "An inverter and a grounded converter for each node."},
      {Realization::crossbar, "crossbar",
       "An amplifier for each node, around the array of conductances P."},
      {Realization::least_squares, "least_squares", "Two arrays, K and K': P is never formed."},
      {Realization::lattice, "lattice",
       "Two arrays with passive nodes between them: residuals without amplifiers."},
      {Realization::lc, "lc", "Capacitors and inductors at one frequency (thesis 5.2, i)."},
      {Realization::ndr, "ndr", "Devices of negative differential resistance (thesis 5.2, iii)."}};
};

inline constexpr std::array realizations = {
    Realization::ideal,         Realization::nic,     Realization::rail, Realization::crossbar,
    Realization::least_squares, Realization::lattice, Realization::lc,   Realization::ndr};

[[nodiscard]] std::string_view name(Realization realization) noexcept;
[[nodiscard]] std::optional<Realization> realization_named(std::string_view text) noexcept;

/// What a network solves: P f = b, and the least-squares problem that it comes from.
struct NetworkProblem {
  Matrix matrix{};                   ///< P = K'K + R
  std::vector<double> right_side{};  ///< b = K'g
  Matrix kernel{};                   ///< K: weighted, with the pitch
  Matrix stabiliser{};               ///< R = alpha L'L
  std::vector<double> readings{};    ///< g, weighted
  /// Of the nodes; none: n0, n1, ... Each is one word of ASCII letters, digits, _ and . that no
  /// other node has, whatever its case, nodes of the circuit's own (s0, e0, ...) included.
  std::vector<std::string> names{};
};

/// @throw std::invalid_argument  alpha is not > 0 and finite, readings have the wrong size
[[nodiscard]] NetworkProblem network_problem(const LinearProblem& problem, double alpha,
                                             std::span<const double> readings);

/// How readings come in.
enum class Inputs { current, voltage };

template <>
struct Enumerators<Inputs> {
  static constexpr Enumerator<Inputs> all[] = {
      {Inputs::current, "current", "Ideal currents."},
      {Inputs::voltage, "voltage", "Voltages, each through a resistor of the circuit."}};
};

struct RealizationOptions {
  Scale scale{};
  OpAmp opamp{};
  /// Voltages where op-amps drive the nodes: through resistors, so that no voltage is above the
  /// largest that the answer could reach with it. What all resistors have in common then cancels.
  Inputs inputs = Inputs::current;
  /// Where op-amps drive the nodes: inverters instead of complementary outputs.
  bool inverters = false;
  double residual_gain = 10.0;  ///< least_squares: rho, the residual amplifiers' gain, > 0
  /// least_squares: the tractions are nodes of resistors between the amplifiers, in place of the
  /// stabiliser's differences of large currents. The stabiliser R must be an M-matrix that
  /// resistors can make: entries off the diagonal <= 0, sums of rows > 0.
  bool ladder = false;
  /// Where op-amps drive the nodes: bandwidth of the main ones over that of the others; absent:
  /// 1, and with inverters what keeps the loop stable: 1/2 (crossbar), 0.2/rho (least_squares).
  std::optional<double> bandwidth_ratio{};
  double divider = 1e4;  ///< resistors of converters and inverters [ohm], > 0
  /// To ground, at every node of the network [F], > 0. Where the nodes are op-amps' outputs it
  /// loads these as `OpAmp::load_capacitance` does.
  std::optional<double> node_capacitance{};
  /// Across every resistor but those inside converters and inverters [F], > 0.
  std::optional<double> resistor_capacitance{};
  double frequency = 1e4;             ///< lc [Hz], > 0
  Curve curve = Curve::tunnel_diode;  ///< ndr
  double device_volts = 100.0;        ///< ndr: V of the devices [V], > 0

  /// Whether capacitance stands anywhere, op-amps' pins included.
  [[nodiscard]] bool has_capacitance() const noexcept {
    return node_capacitance || resistor_capacitance || opamp.input_capacitance ||
           opamp.differential_capacitance || opamp.load_capacitance;
  }

  /// `bandwidth_ratio`, its default filled in.
  [[nodiscard]] double main_bandwidth(Realization realization) const noexcept;
};

/// @throw std::invalid_argument  an option is out of range
void check(const RealizationOptions& options);

/// What a theorem on stability asks for beyond what it says of P.
enum class TheoremCondition {
  definite,                       ///< P is positive definite
  no_input_capacitance,           ///< none at the op-amps' inputs
  no_inverter_input_capacitance,  ///< none at the inverters' inputs
  no_resistor_capacitance,        ///< none across the resistors
  no_second_pole,                 ///< of the op-amps
  /// No capacitance at inverting inputs; or one pole, and dividers of 1/(W C (1 + sqrt(1 + 1/A)))
  /// at most, A the gain: 1/(2 W C) where it is large.
  divider_fast_enough,
  /// No second pole; or no capacitance at summing nodes; or the pole at or above the bandwidth.
  second_pole_beyond_bandwidth,
  /// No capacitance at inputs; or no second pole; or the pole at or above twice the bandwidth.
  second_pole_beyond_twice_bandwidth,
  lag_within_bound,  ///< of capacitance and second poles together
  /// Capacitance at nodes that nothing drives; or a second pole and capacitance at inputs.
  one_lag,
  complementary_outputs,           ///< inverters are not covered: never met with them
  main_at_most_half_of_inverters,  ///< bandwidth of the main op-amps over the inverters'
  main_slow_enough,                ///< how slow is enough is not proven: never met
  no_output_resistance,            ///< of the op-amps
  no_common_mode_error,            ///< of the op-amps
  no_node_capacitance,             ///< none at the network's nodes, or the residuals'
  /// Of finite gain: what holds an output at rest is at most two thirds of the slew.
  slew_holds_outputs,
  no_own_capacitances,  ///< none that differs from node to node, as a board's (`NetworkCircuit`)
};

/// What is proven of a realisation's stability (proofs: docs/circuits.md).
struct StabilityTheorem {
  std::string_view name{};                    ///< "T5"
  std::string_view statement{};               ///< one sentence
  std::span<const TheoremCondition> needs{};  ///< in the order in which they are checked
  /// Whether capacitances may differ from node to node: where not, `no_own_capacitances` too.
  bool any_capacitances = false;
};

/// What a realisation is. Code that treats realisations differently asks these, not which one it
/// is: one more of them is one file and one row of the table in src/network/realizations.
struct RealizationTraits {
  Realization realization = Realization::ideal;

  enum class Parts {
    linear,    ///< resistors and op-amps: has `Reduction` and tolerances
    lossless,  ///< capacitors and inductors: has its answer at one frequency, and never settles
    curved,    ///< resistors and N-shaped devices, linear for small voltages
  };
  Parts parts = Parts::linear;

  bool uses_opamps = false;
  /// The number of op-amps grows with the square of that of the nodes.
  bool opamps_per_branch = false;
  /// The network's nodes are op-amps' outputs. Such a realisation has a second form with inverters
  /// in place of complementary outputs, and its main op-amps may be slower than the others.
  bool drives_nodes = false;
  /// Built from K and the readings: P is never formed, and K'K + R is definite whatever rounding
  /// makes of it.
  bool takes_readings = false;
  /// Residuals are nodes that nothing drives.
  bool passive_residuals = false;
  /// What a simulator's elimination may leave in the answer for a well-conditioned P, relative.
  double rounding = 1e-10;

  StabilityTheorem theorem{};
  StabilityTheorem theorem_with_inverters{};  ///< if `drives_nodes`
  StabilityTheorem theorem_with_ladder{};     ///< no name: it has no such form
  StabilityTheorem theorem_of_slewing{};      ///< of op-amps that slew; no name: none is proven
  /// With inverters: default of `RealizationOptions::bandwidth_ratio`; nullptr: 1.
  double (*bandwidth_ratio)(const RealizationOptions&) = nullptr;

  Circuit (*build)(const NetworkProblem& problem, const RealizationOptions& options) = nullptr;

  [[nodiscard]] constexpr bool linear() const noexcept { return parts == Parts::linear; }
};

[[nodiscard]] const RealizationTraits& traits(Realization realization) noexcept;

/// Whether the network's nodes are op-amps' outputs.
[[nodiscard]] bool has_nodes_at_outputs(Realization realization,
                                        const RealizationOptions& options) noexcept;

/// Whether the options ask for a ladder and the realisation has that form.
[[nodiscard]] bool has_ladder(Realization realization, const RealizationOptions& options) noexcept;

/// Whether a realisation is built from op-amps.
[[nodiscard]] bool has_amplifiers(Realization realization) noexcept;

/// Whether something in the circuit has a time of its own that is modelled: op-amps with a
/// bandwidth, or nodes with capacitance where there are none. A lossless circuit is for one
/// frequency.
[[nodiscard]] bool takes_time(Realization realization, const RealizationOptions& options) noexcept;

/// Builds the circuit. Its nodes are n0, n1, ..., or as the problem names them, one per row of P,
/// and are its outputs; sources are I0, I1, ..., of voltages V0, ... behind resistors Ri0, ...;
/// parts are named after the entry of P or K that they stand for. How each realisation does it
/// stands at the head of its file in src/network/realizations.
///
/// @throw std::invalid_argument  sizes differ, a value is not finite, P is not symmetric, K is zero
///                               where it is used, a node's name cannot be used, or an option is
///                               out of range
[[nodiscard]] Circuit realize(Realization realization, const NetworkProblem& problem,
                              const RealizationOptions& options = {});

}  // namespace tactile_net
