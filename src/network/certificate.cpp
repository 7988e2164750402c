#include "tactile_net/network/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "network/angular_frequency.hpp"
#include "network/lag_bound.hpp"
#include "network/output_current.hpp"
#include "network/scale_proposal.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/named.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/slewing.hpp"

namespace tactile_net {
namespace {

/// Of converters and inverters whose op-amps have a bandwidth and capacitance at their inputs:
/// x = W C r of x^2 / A + 2 x = 1.
double largest_divider(const OpAmp& o) {
  const double x = 1.0 / (1.0 + std::sqrt(1.0 + 1.0 / o.dc_gain()));
  return x / (angular_frequency(*o.bandwidth) * *o.input_capacitance);
}

/// Whether capacitance is stated at op-amps' outputs.
bool has_loaded_outputs(const NetworkCircuit& circuit) {
  const RealizationOptions& options = circuit.options();
  return options.opamp.load_capacitance || !circuit.capacitances().empty() ||
         (options.node_capacitance && has_nodes_at_outputs(circuit.realization(), options));
}

/// 0: nothing takes a time that is modelled.
std::size_t states_of(const NetworkCircuit& circuit) {
  return takes_time(circuit.realization(), circuit.options()) ? count_states(circuit.flat()) : 0;
}

/// Whether the state space is the circuit's own, with everything that is stated, and is decomposed.
bool has_poles(const NetworkCircuit& circuit) {
  const std::size_t states = states_of(circuit);
  return states > 0 && states <= most_states;
}

/// Below the rounding of P's entries either sign means nothing.
double least_eigenvalue_that_counts(const NetworkCircuit& circuit) {
  return static_cast<double>(circuit.problem().matrix.rows) *
         std::numeric_limits<double>::epsilon() * circuit.eigenvalues().largest;
}

bool is_definite(const NetworkCircuit& circuit) {
  return traits(circuit.realization()).takes_readings ||
         circuit.eigenvalues().smallest > least_eigenvalue_that_counts(circuit);
}

/// Whether the rate that finite gain asks for at rest is at most two thirds of the slew: beyond,
/// bends of rates about the rest differ by more than T8's dominance bears.
bool slew_holds_outputs(const NetworkCircuit& circuit) {
  const OpAmp& o = circuit.options().opamp;
  if (!o.slew || !o.bandwidth) return true;
  double largest = 0.0;
  for (const double volts : operating_voltages(circuit.flat()))
    largest = std::max(largest, std::abs(volts));
  return 1.5 * angular_frequency(*o.bandwidth) * largest / o.dc_gain() <= *o.slew;
}

bool is_met(TheoremCondition condition, const NetworkCircuit& circuit, bool definite,
            UnmetCondition& unmet) {
  const RealizationOptions& options = circuit.options();
  const OpAmp& o = options.opamp;
  const double ratio = options.main_bandwidth(circuit.realization());
  const bool at_inputs =
      o.input_capacitance || o.differential_capacitance || !circuit.capacitances().empty();
  switch (condition) {
    case TheoremCondition::definite:
      return definite;
    case TheoremCondition::no_input_capacitance:
    case TheoremCondition::no_inverter_input_capacitance:
      return !at_inputs;
    case TheoremCondition::no_resistor_capacitance:
      return !options.resistor_capacitance;
    case TheoremCondition::no_second_pole:
      return !o.second_pole;
    case TheoremCondition::divider_fast_enough:
      return !at_inputs || (o.bandwidth && !o.second_pole && !o.differential_capacitance &&
                            options.divider <= largest_divider(o));
    case TheoremCondition::second_pole_beyond_bandwidth:
      return !o.second_pole || !at_inputs || *o.second_pole >= ratio * *o.bandwidth;
    case TheoremCondition::second_pole_beyond_twice_bandwidth:
      return !o.second_pole || !at_inputs || *o.second_pole >= 2.0 * ratio * *o.bandwidth;
    case TheoremCondition::lag_within_bound:
      if (!at_inputs && !o.second_pole &&
          !(options.node_capacitance && has_ladder(circuit.realization(), options)))
        return true;
      if (!o.bandwidth) return false;
      unmet.lag = lag_bound(circuit);
      return unmet.lag.number < 1.0;
    case TheoremCondition::one_lag:
      return !options.node_capacitance || (!o.second_pole && !at_inputs);
    case TheoremCondition::complementary_outputs:
      return !options.inverters;
    case TheoremCondition::main_at_most_half_of_inverters:
      unmet.bandwidth_ratio = ratio;
      return ratio <= 0.5;
    case TheoremCondition::main_slow_enough:
      return false;
    case TheoremCondition::no_output_resistance:
      return !o.output_resistance;
    case TheoremCondition::no_common_mode_error:
      return !o.common_mode_rejection;
    case TheoremCondition::no_node_capacitance:
      return !options.node_capacitance;
    case TheoremCondition::slew_holds_outputs:
      return slew_holds_outputs(circuit);
    case TheoremCondition::no_own_capacitances:
      return circuit.capacitances().empty();
  }
  return false;
}

const StabilityTheorem& theorem_on_stability(const NetworkCircuit& circuit) {
  const RealizationTraits& one = traits(circuit.realization());
  const RealizationOptions& options = circuit.options();
  if (one.drives_nodes && options.inverters) return one.theorem_with_inverters;
  return has_ladder(one.realization, options) ? one.theorem_with_ladder : one.theorem;
}

Theorem judged(const StabilityTheorem& said, const NetworkCircuit& circuit, bool definite) {
  Theorem theorem{.name = said.name, .statement = said.statement, .unmet = {}};
  const auto judge = [&](TheoremCondition condition) {
    UnmetCondition unmet{.condition = condition};
    if (!theorem.unmet && !is_met(condition, circuit, definite, unmet)) theorem.unmet = unmet;
  };
  for (const TheoremCondition condition : said.needs) judge(condition);
  if (!said.any_capacitances) judge(TheoremCondition::no_own_capacitances);
  return theorem;
}

/// How the rows behind the outputs' are to be scaled for their coupling to be skew: amplifiers that
/// float see their residuals through two arrays, one the other times a constant.
double skew_scale(const Eigen::MatrixXd& s, Eigen::Index outputs) {
  const Eigen::Index rest = s.rows() - outputs;
  const auto from_rest = s.topRightCorner(outputs, rest);
  const auto into_rest = s.bottomLeftCorner(rest, outputs);
  return -from_rest.cwiseProduct(into_rest.transpose()).sum() / into_rest.squaredNorm();
}

/// Largest eps with D^-1/2 (sym S - eps B) D^-1/2 > 0 for every error within eps B: 1 over the
/// largest eigenvalue of D^-1/2 B D^-1/2. D holds the least eigenvalue of the outputs' diagonal
/// block of sym S, and the diagonal of the rest's times its least eigenvalue in those units; their
/// coupling must be skew: then sym S >= D.
std::optional<double> margin_of(const Reduction& reduction, const Equations& equations) {
  Eigen::MatrixXd s = as_eigen(equations.matrix);
  const Matrix entries = reduction.sensitivity_bound();
  Eigen::MatrixXd b = as_eigen(entries);
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  const Eigen::Index rest = s.rows() - n;
  if (!equations.input.values.empty()) {
    const double scale = skew_scale(s, n);
    s.bottomRows(rest) *= scale;
    b.bottomRows(rest) *= scale;
  }
  const Eigen::MatrixXd symmetric = 0.5 * (s + s.transpose());
  const auto least = [](const Eigen::MatrixXd& block) { return symmetric_eigenvalues(block)(0); };
  Eigen::VectorXd d(s.rows());
  d.head(n).setConstant(least(symmetric.topLeftCorner(n, n)));
  if (rest > 0) {
    const Eigen::VectorXd diagonal = symmetric.diagonal().tail(rest);
    if (!(diagonal.minCoeff() > 0.0)) return std::nullopt;
    const Eigen::VectorXd units = diagonal.cwiseSqrt().cwiseInverse();
    d.tail(rest) = diagonal * least(units.asDiagonal() * symmetric.bottomRightCorner(rest, rest) *
                                    units.asDiagonal());
  }
  // What rounding may have made of the least eigenvalue proves nothing.
  const double rounding =
      static_cast<double>(s.rows()) * std::numeric_limits<double>::epsilon() * symmetric.norm();
  if (!(d.head(n).minCoeff() > rounding) || !(d.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::VectorXd root = d.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd bound = root.asDiagonal() * (0.5 * (b + b.transpose())) * root.asDiagonal();
  const double x = 1.0 / symmetric_eigenvalues(bound)(s.rows() - 1);
  // An entry is at most g up / down, whose errors make (1 + e) / (1 - e)^2 - 1 <= 3 e / (1 - e)^2.
  // 3 e is in the bound: e / (1 - e)^2 <= x, solved without a difference of large numbers.
  return 2.0 * x / (1.0 + 2.0 * x + std::sqrt(1.0 + 4.0 * x));
}

Dynamics dynamics_of(const NetworkCircuit& circuit, double accuracy) {
  const StateSpace& system = circuit.state_space();
  Dynamics dynamics{.states = system.states(), .poles = circuit.poles()};
  dynamics.slowest = dynamics.poles.front().real();
  for (const auto& pole : dynamics.poles)
    if (std::abs(pole) > 0.0)
      dynamics.damping = std::min(dynamics.damping, -pole.real() / std::abs(pole));
  if (dynamics.slowest < 0.0)
    dynamics.settling_seconds = settling_time(system, accuracy, dynamics.slowest);
  else
    dynamics.mode = slowest_mode(system);
  if (!system.slewing.empty() && dynamics.settling_seconds &&
      system.states() <= most_slewing_states) {
    dynamics.unslewed_seconds = dynamics.settling_seconds;
    dynamics.settling_seconds = slewing_settling_time(system, accuracy, dynamics.slowest);
  }
  dynamics.rings = dynamics.poles.front().imag() != 0.0;
  return dynamics;
}

/// Where an output has neither capacitance nor a pole its white noise has no size: no number then.
void add_noise(Certificate& c, const NetworkCircuit& circuit) {
  const OpAmp& opamp = circuit.options().opamp;
  if (!opamp.noise_voltage && !opamp.noise_current) return;
  OutputNoise noise;
  try {
    noise = output_noise(circuit.flat());
  } catch (const std::domain_error&) {
    c.remarks.push_back({.kind = CircuitRemark::Kind::noise_without_capacitance});
    return;
  }
  const std::vector<double> answer = steady_state(circuit.state_space());
  const Eigen::VectorXd thermal = as_eigen(noise.thermal).diagonal();
  const Eigen::VectorXd flicker = as_eigen(noise.flicker).diagonal();
  const Eigen::VectorXd all = thermal + as_eigen(noise.amplifiers).diagonal() + flicker;
  c.noise = CircuitNoise{.largest = std::sqrt(all.maxCoeff()),
                         .total = std::sqrt(all.sum()),
                         .relative = std::sqrt(all.sum()) / as_eigen(std::span(answer)).norm(),
                         .thermal = thermal.sum() / all.sum(),
                         .flicker = flicker.sum() / all.sum()};
}

/// Measured, no theorem: W C/D up to which the same capacitance at floating inputs and at passive
/// residuals was stable, by the second pole over the bandwidth (docs/circuits.md).
double floating_capacitance_limit(const OpAmp& o) {
  if (!o.second_pole) return 1.9;
  return *o.second_pole >= 2.0 * *o.bandwidth ? 0.9 : 0.46;
}

/// Where the op-amps' limits and capacitances come in.
void add_opamp_remarks(Certificate& c, const NetworkCircuit& circuit, const Equations& equations) {
  using Kind = CircuitRemark::Kind;
  const RealizationOptions& options = circuit.options();
  const RealizationTraits& realization = traits(circuit.realization());
  const OpAmp& o = options.opamp;
  const double reach = o.rail ? *o.rail - 0.6 : 0.0;  // where the clamp's diodes begin to conduct
  if (o.rail && c.largest_voltage > reach)
    c.remarks.push_back({.kind = Kind::clamps,
                         .value = c.largest_voltage,
                         .limit = reach,
                         .repair = 0.8 * reach / c.largest_voltage * options.scale.volts});
  if (realization.uses_opamps && has_loaded_outputs(circuit) != o.output_resistance.has_value())
    c.remarks.push_back(
        {.kind = o.output_resistance ? Kind::outputs_without_load : Kind::capacitance_at_outputs,
         .repair = circuit.capacitances().empty() ? 1e-12 : 0.0});
  if (c.theorem.unmet && c.theorem.unmet->lag.number > 0.0)
    c.remarks.push_back({.kind = c.theorem.unmet->lag.of_nodes ? Kind::node_lag : Kind::summing_lag,
                         .value = c.theorem.unmet->lag.number,
                         .limit = c.theorem.unmet->lag.bandwidth_ratio,
                         .repair = c.theorem.unmet->lag.siemens});
  if (!o.bandwidth || !(o.input_capacitance || o.differential_capacitance)) return;
  if (o.input_capacitance && circuit.flat().had_subcircuits() &&
      options.divider > largest_divider(o))
    c.remarks.push_back({.kind = Kind::divider_rings,
                         .value = options.divider,
                         .limit = largest_divider(o),
                         .repair = 0.99 * largest_divider(o)});
  if (realization.passive_residuals && options.node_capacitance) {
    const double least = *std::min_element(
        equations.total.begin() + static_cast<std::ptrdiff_t>(circuit.reduction().outputs()),
        equations.total.end());
    // Between the inputs it counts twice: half of their difference lies across it.
    const double farad =
        std::max(o.input_capacitance.value_or(0.0) + 2.0 * o.differential_capacitance.value_or(0.0),
                 *options.node_capacitance);
    const double value = angular_frequency(*o.bandwidth) * farad / least;
    const double limit = floating_capacitance_limit(o);
    if (value > limit)
      c.remarks.push_back({.kind = Kind::floating_input_capacitance,
                           .value = value,
                           .limit = limit,
                           .repair = options.scale.siemens * value / limit});
  }
}

/// What nobody could buy or measure.
void add_scale_remarks(Certificate& c, const Scale& scale) {
  using Kind = CircuitRemark::Kind;
  if (c.least_ohm > 0.0 && (c.greatest_ohm > 1e9 || c.least_ohm < 1.0))
    c.remarks.push_back(
        {.kind = Kind::not_for_sale,
         .least = c.least_ohm,
         .greatest = c.greatest_ohm,
         .repair = scale.siemens * std::sqrt(c.least_ohm) * std::sqrt(c.greatest_ohm) / 1e5});
  if (c.largest_voltage > 100.0 || (c.largest_voltage > 0.0 && c.largest_voltage < 1e-4))
    c.remarks.push_back({.kind = Kind::odd_voltage,
                         .value = c.largest_voltage,
                         .repair = scale.volts / c.largest_voltage});
  if (c.least_ohm > 0.0 && c.greatest_ohm > 1e15 * c.least_ohm)
    c.remarks.push_back(
        {.kind = Kind::beyond_digits, .least = c.least_ohm, .greatest = c.greatest_ohm});
}

/// What the reduced equations say: voltages, heat, and the errors of components they bear.
void add_equations(Certificate& c, const NetworkCircuit& circuit) {
  const Reduction& reduction = circuit.reduction();
  const RealizationOptions& options = circuit.options();
  const Equations equations = reduction.equations();
  const Eigen::VectorXd right = as_eigen(std::span(equations.right_side));
  const Eigen::VectorXd z = Lu(as_eigen(equations.matrix)).solve(right);
  if (!z.allFinite()) throw std::domain_error("the network has no unique answer");
  const Reduction::Load load = reduction.load({z.data(), static_cast<std::size_t>(z.size())});
  c.largest_voltage = load.largest_voltage;
  for (const CurrentSource& one : circuit.circuit().sources)
    if (one.volts) c.input_volts = std::max(c.input_volts.value_or(0.0), std::abs(*one.volts));
  c.power = load.power;
  // Errors of a ladder move the metric in which its energy falls, and second poles or capacitance
  // beside the amplifiers' poles leave no metric at all once errors make the coupling unequal: no
  // margin is proven then.
  const bool floating = traits(c.realization).passive_residuals;
  const bool one_pole = !options.opamp.second_pole && !options.opamp.input_capacitance &&
                        circuit.capacitances().empty() && !options.opamp.differential_capacitance &&
                        !(floating && options.node_capacitance);
  if (c.theorem.holds() && !c.ladder && (one_pole || !has_amplifiers(c.realization)))
    c.tolerance_margin = margin_of(reduction, equations);
  const bool exact = c.tolerance_margin && !circuit.flat().had_subcircuits();
  c.margin_for_any_bandwidth = exact && !floating;
  c.margin_for_one_bandwidth = exact && floating;
  add_opamp_remarks(c, circuit, equations);
  add_scale_remarks(c, options.scale);
}

void add_slewing_remarks(Certificate& c, const NetworkCircuit& circuit) {
  using Kind = CircuitRemark::Kind;
  const RealizationOptions& options = circuit.options();
  if (!options.opamp.slew || !(c.dynamics->slowest < 0.0)) return;
  if (circuit.state_space().states() > most_slewing_states) {
    c.remarks.push_back({.kind = Kind::slewing_left_out});
    return;
  }
  const double demand = slewing_demand(circuit.state_space());
  if (demand > 1.0)
    c.remarks.push_back({.kind = Kind::slews,
                         .value = demand * *options.opamp.slew,
                         .limit = *options.opamp.slew,
                         .repair = options.scale.volts / demand});
}

/// What real inputs and outputs do to the answer at rest, of a load.
void add_errors(Certificate& c, const NetworkCircuit& circuit) {
  const OpAmp& o = circuit.options().opamp;
  if (!has_amplifiers(c.realization) ||
      !(o.offset || o.bias_current || o.common_mode_rejection || o.output_resistance))
    return;
  const std::vector<double>& b = circuit.problem().right_side;
  if (std::all_of(b.begin(), b.end(), [](double value) { return value == 0.0; })) return;
  c.errors = static_errors(circuit.flat());
}

/// What its outputs carry of a load, where the op-amps' limit is given.
void add_output_current(Certificate& c, const NetworkCircuit& circuit) {
  const RealizationOptions& options = circuit.options();
  const std::vector<double>& b = circuit.problem().right_side;
  if (!options.opamp.output_current || !has_amplifiers(c.realization) ||
      std::all_of(b.begin(), b.end(), [](double value) { return value == 0.0; }))
    return;
  c.output_current = output_current(circuit.flat());
  const double limit = *options.opamp.output_current;
  if (c.output_current->largest > limit)
    c.remarks.push_back({.kind = CircuitRemark::Kind::output_current,
                         .value = c.output_current->largest,
                         .limit = limit,
                         .repair = options.scale.volts * limit / c.output_current->largest,
                         .part = c.output_current->opamp});
}

StabilityVerdict verdict_of(const NetworkCircuit& circuit, const Theorem& theorem, bool definite) {
  if (!definite) return {Stability::not_definite};
  if (traits(circuit.realization()).parts == RealizationTraits::Parts::lossless)
    return {Stability::lossless};
  if (has_poles(circuit))
    return {circuit.poles().front().real() < 0.0 ? Stability::stable : Stability::unstable};
  if (theorem.holds()) return {Stability::stable};
  return {Stability::not_modelled, states_of(circuit) > 0 ? UnknownStability::too_many_states
                                                          : UnknownStability::no_bandwidth};
}

/// What the poles say, where there are any.
void add_dynamics(Certificate& c, const NetworkCircuit& circuit) {
  if (states_of(circuit) > most_states)
    c.remarks.push_back({.kind = CircuitRemark::Kind::too_many_states});
  if (!has_poles(circuit)) return;
  c.dynamics = dynamics_of(circuit, c.accuracy);
  if (c.dynamics->slowest < 0.0) add_noise(c, circuit);
  add_slewing_remarks(c, circuit);
}

}  // namespace

std::string_view name(Stability stability) noexcept {
  return name_in<Enumerators<Stability>::all>(stability);
}

StabilityVerdict stability_of(const NetworkCircuit& circuit) {
  const bool definite = is_definite(circuit);
  return verdict_of(circuit, judged(theorem_on_stability(circuit), circuit, definite), definite);
}

Certificate certify(const NetworkCircuit& circuit, double accuracy) {
  if (!(accuracy > 0.0 && accuracy < 1.0))
    throw std::invalid_argument("the accuracy must be > 0 and < 1");
  const RealizationTraits& realization = traits(circuit.realization());
  Certificate c{.realization = circuit.realization(), .accuracy = accuracy};
  c.ladder = has_ladder(c.realization, circuit.options());
  const EigenvalueRange& eigenvalues = circuit.eigenvalues();
  c.smallest_eigenvalue = eigenvalues.smallest;
  const bool definite = is_definite(circuit);
  c.condition = c.smallest_eigenvalue > least_eigenvalue_that_counts(circuit)
                    ? eigenvalues.largest / c.smallest_eigenvalue
                    : std::numeric_limits<double>::infinity();
  c.theorem = judged(theorem_on_stability(circuit), circuit, definite);
  if (circuit.options().opamp.slew && !realization.theorem_of_slewing.name.empty())
    c.slewing = judged(realization.theorem_of_slewing, circuit, definite);
  c.elements = count_elements(circuit.flat());
  for (const double ohm : resistances(circuit.flat())) {
    const double size = std::abs(ohm);
    c.least_ohm = c.least_ohm == 0.0 ? size : std::min(c.least_ohm, size);
    c.greatest_ohm = std::max(c.greatest_ohm, size);
  }

  const StabilityVerdict verdict = verdict_of(circuit, c.theorem, definite);
  c.stability = verdict.stability;
  c.unknown = verdict.unknown;
  if (realization.parts == RealizationTraits::Parts::lossless) {
    if (circuit.options().node_capacitance || circuit.options().resistor_capacitance)
      c.remarks.push_back({.kind = CircuitRemark::Kind::capacitance_at_one_frequency});
    return c;
  }
  if (realization.linear()) add_equations(c, circuit);
  add_errors(c, circuit);
  add_output_current(c, circuit);
  add_dynamics(c, circuit);
  c.proposal = scale_proposal(c, circuit);
  return c;
}

Certificate certify(Realization realization, const NetworkProblem& problem,
                    const RealizationOptions& options, double accuracy) {
  const std::shared_ptr<const NetworkProblem> not_owned(std::shared_ptr<void>(), &problem);
  return certify(NetworkCircuit(realization, not_owned, options), accuracy);
}

}  // namespace tactile_net
