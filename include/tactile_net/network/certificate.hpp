/// @file
/// What can be said of a circuit before it is built: whether it settles, how fast, what errors of
/// its components it bears, and what it asks of its amplifiers.
///
///     const NetworkProblem network = network_problem(problem, alpha, readings);
///     const Certificate certificate =
///         certify(Realization::least_squares, network, {.opamp = {.bandwidth = 10e6}});
///     name(certificate.stability);     // "stable"; examples/06_certificate.cpp
///     certificate.tolerance_margin;    // errors of parts that it bears
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

/// Where it is `not_modelled`, `UnknownStability` says why.
enum class Stability { stable, unstable, not_definite, lossless, not_modelled };

template <>
struct Enumerators<Stability> {
  static constexpr Enumerator<Stability> all[] = {
      {Stability::stable, "stable",
       "Every pole lies in the left half plane, or a theorem says so."},
      {Stability::unstable, "unstable", "A pole lies in the right half plane."},
      {Stability::not_definite, "not_definite",
       "P is not positive definite: no circuit of ideal op-amps settles for it."},
      {Stability::lossless, "lossless", "Capacitors and inductors alone: it rings for ever."},
      {Stability::not_modelled, "not_modelled", "It is not known whether the circuit is stable."}};
};

[[nodiscard]] std::string_view name(Stability stability) noexcept;

/// Why stability is not known. In all of these no theorem's conditions are met either.
enum class UnknownStability {
  no_bandwidth,     ///< the op-amps have none: no poles
  too_many_states,  ///< more than `most_states`: the poles are not computed
};

struct StabilityVerdict {
  Stability stability = Stability::not_modelled;
  std::optional<UnknownStability> unknown{};  ///< if and only if it is `not_modelled`
};

/// How much lag the loop of `least_squares` has, and what brings it within theorem T6: stable where
/// 4 theta^2 W_main tau < gamma (1 - W tau/4)^2, tau the largest C/D + 1/W2 of a row, W the
/// amplifiers' largest bandwidth times 1 + 1/gain, W_main the main ones' [1/s]. The same of T6L; of
/// capacitance at the nodes of its ladder 4 theta^2 W_main tau < gamma.
struct LagBound {
  double number = 0.0;   ///< the left side over the right one; infinite: W tau is 4 or more
  double siemens = 0.0;  ///< the least `Scale::siemens` that makes it 1; 0: second poles exceed it
  double bandwidth_ratio = 0.0;  ///< the largest that makes it 1; 0: none is known
  bool of_nodes = false;         ///< the lag of a ladder's nodes
};

/// A condition of a theorem that a circuit does not meet.
struct UnmetCondition {
  TheoremCondition condition = TheoremCondition::definite;
  /// main_at_most_half_of_inverters: what the circuit has, over the inverters' bandwidth.
  double bandwidth_ratio = 0.0;
  LagBound lag{};  ///< lag_within_bound
};

/// The theorem on a realisation, and whether it speaks of this circuit.
struct Theorem {
  std::string_view name{};                ///< "T5"
  std::string_view statement{};           ///< one sentence
  std::optional<UnmetCondition> unmet{};  ///< the first one; absent: all are met

  [[nodiscard]] bool holds() const noexcept { return !unmet; }
};

/// A rule that a circuit breaks, and the number that mends it. Numbers that a kind does not name
/// are 0.
struct CircuitRemark {
  enum class Kind {
    /// A node would reach `value` [V], op-amps clamp from `limit` [V]; `repair`: `Scale::volts`.
    clamps,
    /// Capacitance at op-amps' outputs has no effect: they have no resistance.
    capacitance_at_outputs,
    /// Outputs have a resistance, with which any load's capacitance makes a pole in every loop, and
    /// none is stated.
    outputs_without_load,
    /// Capacitance is left out: at one frequency it is part of the network's own capacitors.
    capacitance_at_one_frequency,
    /// Resistors of `value` [ohm] at inverting inputs ring with their capacitance; `repair`: the
    /// largest `divider` [ohm] that does not.
    divider_rings,
    /// The lag of summing nodes and second poles is `value` times what is proven stable; `repair`,
    /// `limit`: `LagBound::siemens`, `LagBound::bandwidth_ratio`.
    summing_lag,
    /// The same of capacitance at a ladder's nodes.
    node_lag,
    /// Capacitance at floating inputs and residuals, W C/D = `value`, beyond what was found stable,
    /// `limit`; `repair`: the least `Scale::siemens` that is not.
    floating_input_capacitance,
    /// Resistors from `least` to `greatest` [ohm] cannot be bought; `repair`: the `Scale::siemens`
    /// that centres them at 100 kilo-ohm.
    not_for_sale,
    /// The largest voltage is `value` [V]; `repair`: the `Scale::volts` that makes it 1 V.
    odd_voltage,
    /// Resistors from `least` to `greatest` [ohm]: further apart than a simulator's digits.
    beyond_digits,
    /// More than `most_states` states: poles and settling time are left out.
    too_many_states,
    /// From rest op-amps would have to rise at `value` [V/s], more than their slew, `limit`;
    /// `repair`: the `Scale::volts` from which they do not slew.
    slews,
    /// More than `most_slewing_states` states: the settling time is without the slew.
    slewing_left_out,
    /// The amplifiers' noise is asked for, and an output has no capacitance that ends the
    /// resistors': white noise there has no size.
    noise_without_capacitance,
    /// The op-amps are a part's, of which the figures that `part` names are not known: nothing is
    /// said of what they would do.
    figures_not_known,
    /// At rest an op-amp's output would carry `value` [A], it can give `limit`; `part` names it;
    /// `repair`: the `Scale::volts` at which it carries that.
    output_current,
  };
  Kind kind = Kind::clamps;
  double value = 0.0;
  double limit = 0.0;
  double least = 0.0;
  double greatest = 0.0;
  double repair = 0.0;
  /// What words divide a `repair` of `Scale` by: the unit in which a scene writes it.
  double unit = 1.0;
  std::string part{};
};

/// What the linear state space of the circuit says.
struct Dynamics {
  std::size_t states = 0;
  double slowest = 0.0;  ///< largest real part of a pole [1/s]
  double damping = 1.0;  ///< least -Re/|s| of the poles; 1: no ringing; < 0: growth
  std::optional<double> settling_seconds{};  ///< absent: it does not settle; slewing included
  std::optional<double>
      unslewed_seconds{};  ///< the same without the op-amps' slew, if they have one
  bool rings = false;      ///< the slowest pole is one of a complex pair
  std::vector<std::complex<double>> poles{};  ///< [1/s], the slowest first
  std::vector<double> mode{};  ///< unstable: the growing mode in the outputs, 2-norm 1
};

/// What its resistors at 300 K and its amplifiers' `noise_voltage` make of a circuit at rest.
struct CircuitNoise {
  double largest = 0.0;   ///< of one output, root mean square [V]
  double total = 0.0;     ///< of all outputs, 2-norm [V]
  double relative = 0.0;  ///< `total` over the answer's 2-norm; infinite without a load
  double thermal = 0.0;   ///< the resistors' share of `total` squared
  double flicker = 0.0;   ///< that of the op-amps' 1/f noise, from `lowest_noise_hertz` on
};

/// What the op-amps' outputs carry at rest, both of them where they are complementary.
struct OutputCurrent {
  double largest = 0.0;  ///< of one output [A], in size
  std::string opamp{};   ///< whose: "Xn3"
};

/// Volts and siemens at which what disturbs the answer is least for what the op-amps can give.
struct ScaleProposal {
  /// What keeps the volts from being more.
  enum class Bound { swing, supply, slew, current };
  double volts = 0.0;  ///< `Scale::volts`
  Bound volts_by = Bound::supply;
  double siemens = 0.0;    ///< `Scale::siemens`: the resistors' noise is as large as the op-amps'
  bool least_ohm = false;  ///< less than that: the least resistor would fall below 1 kilo-ohm
  double noise = 0.0;      ///< of the answer, relative, at that scale; 0: none is asked for
  double offset = 0.0;     ///< the same of offsets of either sign
};

template <>
struct Enumerators<ScaleProposal::Bound> {
  static constexpr Enumerator<ScaleProposal::Bound> all[] = {
      {ScaleProposal::Bound::swing, "rail", "A node would reach 0.8 of rail - 0.6 V."},
      {ScaleProposal::Bound::supply, "supply",
       "No rail is given: 2 V at the largest node, of amplifiers of 5 V in all."},
      {ScaleProposal::Bound::slew, "slew", "Slewing would make settling a fifth longer."},
      {ScaleProposal::Bound::current, "current",
       "An output would carry more than the op-amps give, at those siemens."}};
};

struct Certificate {
  Realization realization = Realization::ideal;
  bool ladder = false;               ///< see `has_ladder`
  double smallest_eigenvalue = 0.0;  ///< of P
  double condition = 0.0;            ///< of P, exact; infinite if it is not positive definite
  Stability stability = Stability::not_modelled;
  std::optional<UnknownStability> unknown{};  ///< as `StabilityVerdict::unknown`
  Theorem theorem{};
  /// Every error of resistors up to this, relative, leaves the network stable: proven by the
  /// symmetric part of its equations. Absent: nothing can be proven, as beside second poles and
  /// capacitance at inputs, or the theorem's conditions are not met.
  std::optional<double> tolerance_margin{};
  /// The equations are the circuit's own, so the margin holds for any bandwidths; false where
  /// converters or inverters are taken for fast.
  bool margin_for_any_bandwidth = false;
  bool margin_for_one_bandwidth = false;  ///< the same, as long as the op-amps share it
  /// Absent: op-amps without bandwidth, or too many states.
  std::optional<Dynamics> dynamics{};
  std::optional<CircuitNoise>
      noise{};  ///< absent: none is asked for, it has no size, or the circuit does not settle
  std::optional<Theorem> slewing{};      ///< absent: the op-amps have no slew, or nothing is proven
  std::optional<StaticErrors> errors{};  ///< absent: nothing of the op-amps makes any, or no load
  std::optional<OutputCurrent> output_current{};  ///< absent: the op-amps' is not given, or no load
  std::optional<ScaleProposal> proposal{};        ///< absent: no noise and no offset to balance
  double accuracy = 1e-3;                         ///< that settling is measured to
  ElementCounts elements{};
  double least_ohm = 0.0;        ///< smallest resistor [ohm], in size; 0: there is none
  double greatest_ohm = 0.0;     ///< largest resistor
  double largest_voltage = 0.0;  ///< at any node, ideal amplifiers' outputs included [V]
  double power = 0.0;            ///< heat in the resistors, ideal amplifiers' supply aside [W]
  std::optional<double> input_volts{};  ///< the largest of a reading [V]; absent: they are currents
  std::vector<CircuitRemark> remarks{};  ///< rules that are broken, and what to do
};

/// More states than this are not decomposed: their poles would take minutes.
inline constexpr std::size_t most_states = 1500;

/// Whether the circuit settles, with everything that its options state: by its own poles; where
/// they are not computed by its theorem. Poles stay with the circuit: asked again it costs nothing.
///
/// @throw std::domain_error  the network has no unique answer
[[nodiscard]] StabilityVerdict stability_of(const NetworkCircuit& circuit);

/// What is made for it (flat circuit, reduction, state space, eigenvalues) stays with the circuit.
///
/// @param accuracy  settled: within this of the end, relative to its 2-norm, 0 < accuracy < 1
/// @throw std::invalid_argument  the accuracy is out of range
/// @throw std::domain_error      the network has no unique answer
[[nodiscard]] Certificate certify(const NetworkCircuit& circuit, double accuracy = 1e-3);

/// Builds the circuit for this alone.
///
/// @throw std::invalid_argument  options or accuracy out of range
/// @throw std::domain_error      the network has no unique answer
[[nodiscard]] Certificate certify(Realization realization, const NetworkProblem& problem,
                                  const RealizationOptions& options, double accuracy = 1e-3);

}  // namespace tactile_net
