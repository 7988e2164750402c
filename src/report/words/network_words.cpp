#include "tactile_net/report/words/network_words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tactile_net/network/slewing.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/report/words/opamp_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {
namespace {

/// Of what is proven: no number where nothing is.
std::string multiple(double value) {
  return std::isfinite(value) ? brief(value) + " times" : "far beyond";
}

std::string stability_in_words(const Certificate& c) {
  switch (c.stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "UNSTABLE";
    case Stability::not_definite:
      return "P IS NOT POSITIVE DEFINITE: no circuit of ideal op-amps settles for it";
    case Stability::lossless:
      return "lossless: it rings for ever, and has its answer at one frequency only";
    case Stability::not_modelled:
      return "not known: " + unknown_in_words(c);
  }
  return {};
}

std::string dynamics_in_words(const Certificate& c) {
  const Dynamics& d = *c.dynamics;
  std::string text = std::to_string(d.states) + " states, " +
                     (d.slowest < 0.0 ? "slowest pole at " : "a pole that does not decay at ") +
                     brief(d.slowest) + " 1/s";
  if (d.slowest < 0.0)
    text += d.damping >= 0.999999 ? ", none rings" : ", least damping " + brief(d.damping);
  if (d.settling_seconds.value_or(0.0) > 0.0)
    text += "; settles within " + brief(c.accuracy) + " in " + duration(*d.settling_seconds);
  return text;
}

std::string transient_in_words(const lab::Relaxation& relaxation) {
  const Transient& t = *relaxation.transient;
  const auto& dynamics = relaxation.certificate->dynamics;
  const std::string simulated = duration(t.simulated) + " simulated in " + duration(t.seconds);
  if (t.end == TransientEnd::settles) {
    std::string text = "ngspice's transient settles in " + duration(*t.settling_seconds);
    if (dynamics->settling_seconds)
      text += ", the certificate says " + duration(*dynamics->settling_seconds) + " (" +
              percent(std::abs(*t.settling_seconds / *dynamics->settling_seconds - 1.0)) +
              " apart)";
    return text + "; " + simulated;
  }
  if (t.end == TransientEnd::grows) {
    std::string text = "ngspice's transient GROWS";
    if (t.growth > 0.0) text += " at " + brief(t.growth) + " 1/s";
    if (dynamics->slowest > 0.0)
      text += ", the certificate's pole is at " + brief(dynamics->slowest) + " 1/s";
    if (dynamics->rings) text += " (a ringing pair)";
    if (!dynamics->rings && t.mode.size() == dynamics->mode.size() && !t.mode.empty()) {
      double overlap = 0.0;
      std::size_t largest = 0;
      for (std::size_t i = 0; i < t.mode.size(); ++i) {
        overlap += t.mode[i] * dynamics->mode[i];
        if (std::abs(t.mode[i]) > std::abs(t.mode[largest])) largest = i;
      }
      text += "; the growing mode is largest at " + relaxation.names[largest] +
              ", overlap with the certificate's " + brief(std::abs(overlap));
    }
    return text + "; " + simulated;
  }
  if (t.end == TransientEnd::unfinished)
    return "ngspice's transient did not end within the time limit: not judged; raise " +
           option(Option::time_limit);
  return "ngspice's transient has NOT SETTLED after " + duration(t.simulated);
}

std::string unmet_in_words(const UnmetCondition& unmet) {
  switch (unmet.condition) {
    case TheoremCondition::definite:
      return "P is not positive definite";
    case TheoremCondition::no_input_capacitance:
      return "capacitance at the op-amps' inputs";
    case TheoremCondition::no_inverter_input_capacitance:
      return "capacitance at the inverters' inputs";
    case TheoremCondition::no_resistor_capacitance:
      return "capacitance across resistors";
    case TheoremCondition::no_second_pole:
      return "a second pole";
    case TheoremCondition::divider_fast_enough:
      return "capacitance at inverting inputs beyond 1/(W r (1 + sqrt(1 + 1/A))), or with a second "
             "pole, or between inputs";
    case TheoremCondition::second_pole_beyond_bandwidth:
      return "capacitance at the summing nodes and a second pole below the bandwidth";
    case TheoremCondition::second_pole_beyond_twice_bandwidth:
      return "capacitance at the amplifiers' inputs and a second pole below twice the bandwidth";
    case TheoremCondition::lag_within_bound:
      return (unmet.lag.of_nodes ? "the lag of the ladder's nodes is "
                                 : "the lag of summing nodes and second poles is ") +
             multiple(unmet.lag.number) + " the largest for which it proves stability";
    case TheoremCondition::one_lag:
      return "capacitance at nodes that nothing drives, beside a second pole or capacitance at "
             "inputs";
    case TheoremCondition::complementary_outputs:
      return "inverters in place of complementary outputs";
    case TheoremCondition::main_at_most_half_of_inverters:
      return "main op-amps of " + brief(unmet.bandwidth_ratio) + " times the inverters' bandwidth";
    case TheoremCondition::main_slow_enough:
      return "how slow is enough is not proven";
    case TheoremCondition::no_output_resistance:
      return "output resistance";
    case TheoremCondition::no_common_mode_error:
      return "finite common-mode rejection";
    case TheoremCondition::no_node_capacitance:
      return "capacitance at the residuals' nodes";
    case TheoremCondition::slew_holds_outputs:
      return "a gain so low that an output takes more than two thirds of the slew to be held";
    case TheoremCondition::no_own_capacitances:
      return "capacitances that differ from node to node";
  }
  return {};
}

}  // namespace

std::string unknown_in_words(const Certificate& c) {
  constexpr const char* no_theorem = ", and no theorem's conditions are met";
  switch (c.unknown.value_or(UnknownStability::no_bandwidth)) {
    case UnknownStability::no_bandwidth:
      return std::string("the op-amps have no bandwidth") + no_theorem;
    case UnknownStability::too_many_states:
      return "it has more than " + std::to_string(most_states) +
             " states, so its poles are not computed" + no_theorem;
  }
  return {};
}

std::string circuit_in_words(Realization realization, bool ladder) {
  return std::string(name(realization)) + (ladder ? " with a ladder" : "");
}

std::string elements_in_words(const ElementCounts& elements) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const std::string& kind) {
    if (count > 1) parts.push_back(std::to_string(count) + ' ' + kind + 's');
    if (count == 1) parts.push_back("1 " + kind);
  };
  add(elements.resistors, "resistor");
  if (elements.negative_resistors > 0)
    parts.back() += " (" + std::to_string(elements.negative_resistors) + " negative)";
  add(elements.opamps, "op-amp");
  add(elements.capacitors, "capacitor");
  add(elements.inductors, "inductor");
  add(elements.devices, "N-shaped device");
  add(elements.sources, "source");
  return join(parts, ", ");
}

std::string condition_in_words(const Theorem& theorem) {
  return theorem.unmet ? unmet_in_words(*theorem.unmet) : std::string();
}

std::string in_words(const Theorem& theorem) {
  return "theorem " + std::string(theorem.name) + ": " + std::string(theorem.statement) +
         (theorem.holds() ? " Its conditions hold."
                          : " It does NOT apply here: " + condition_in_words(theorem) + ".");
}

std::string in_words(const CircuitRemark& remark) {
  using Kind = CircuitRemark::Kind;
  const std::string scale = brief(remark.repair / remark.unit);
  const std::string range =
      "resistors from " + brief(remark.least) + " to " + brief(remark.greatest) + " ohm";
  switch (remark.kind) {
    case Kind::clamps:
      return "a node would reach " + brief(remark.value) + " V, op-amps clamp from " +
             brief(remark.limit) + " V (rail - 0.6 V): set volts = " + scale;
    case Kind::capacitance_at_outputs:
      return "capacitance at the amplifiers' outputs has no effect, because they have no "
             "resistance: give the op-amps their output_resistance" +
             (remark.repair > 0.0 ? ", or state what loads their summing nodes, parasitic = { "
                                    "input = " +
                                        brief(remark.repair) + " }"
                                  : std::string{});
    case Kind::outputs_without_load:
      return "with output_resistance any capacitance at an output makes a pole in its loop, and "
             "none is stated: give what the outputs drive, parasitic = { output = 20e-12 }";
    case Kind::capacitance_at_one_frequency:
      return "parasitic.node and parasitic.resistor are left out: at one frequency they are part "
             "of "
             "the network's own capacitors";
    case Kind::divider_rings:
      return "resistors of " + brief(remark.value) +
             " ohm at inverting inputs ring with their capacitance: set divider = " +
             brief(remark.repair) + " at most, 1/(W C (1 + sqrt(1 + 1/A)))";
    case Kind::summing_lag: {
      std::string repair;
      if (remark.repair > 0.0) repair = "siemens = " + scale + " or more";
      if (remark.limit > 0.0)
        repair += (repair.empty() ? "" : ", or ") + ("bandwidth_ratio = " + brief(remark.limit)) +
                  " or less";
      if (repair.empty()) repair = "opamp to faster ones, or realization = \"lattice\"";
      return "the lag of summing nodes and second poles is " + multiple(remark.value) +
             " the largest that is proven stable: set " + repair;
    }
    case Kind::node_lag:
      return "the lag of the ladder's nodes is " + brief(remark.value) +
             " times the largest that is proven stable: set siemens = " + scale +
             " or more, or bandwidth_ratio = " + brief(remark.limit) + " or less";
    case Kind::floating_input_capacitance:
      return "capacitance at the amplifiers' inputs and at the residuals counts (W C/D = " +
             brief(remark.value) + ", found stable up to " + brief(remark.limit) +
             "): siemens = " + scale + " or more";
    case Kind::not_for_sale:
      return range + " cannot be bought: siemens = " + scale + " would centre them at 100 kilo-ohm";
    case Kind::odd_voltage:
      return "the largest voltage is " + brief(remark.value) + " V: volts = " + scale +
             " would make it 1 V";
    case Kind::beyond_digits:
      return range + ": too far apart for the digits of a simulator";
    case Kind::too_many_states:
      return "more than " + std::to_string(most_states) +
             " states: poles and settling time are left out";
    case Kind::slews:
      return "the op-amps slew: from rest they would rise at " + brief(remark.value) +
             " V/s, their slew is " + brief(remark.limit) +
             " V/s; none slews if volts is at most " + scale;
    case Kind::output_current:
      return "the output of " + remark.part + " would carry " + with_unit(remark.value, "A") +
             ", it gives " + with_unit(remark.limit, "A") + " at most: volts = " + scale +
             ", or lower siemens";
    case Kind::figures_not_known:
      return "what the data sheet says of " + remark.part +
             " is not known here, and left out of poles and settling: state it beside the part "
             "under "
             "opamp";
    case Kind::slewing_left_out:
      return "more than " + std::to_string(most_slewing_states) +
             " states: the settling time is without the op-amps' slew";
    case Kind::noise_without_capacitance:
      return "noise is left out: white noise at a node without capacitance is infinite; give the "
             "nodes a capacitance, parasitic = { node = 1e-12 }";
  }
  return {};
}

std::vector<std::string> in_words(const Certificate& c) {
  std::vector<std::string> lines;
  lines.push_back(circuit_in_words(c.realization, c.ladder) + ": " + stability_in_words(c));
  lines.push_back(in_words(c.theorem));
  lines.push_back("P: smallest eigenvalue " + brief(c.smallest_eigenvalue) + ", condition number " +
                  brief(c.condition));
  if (c.dynamics) lines.push_back(dynamics_in_words(c));
  for (std::string& line : opamps_in_words(c)) lines.push_back(std::move(line));
  if (c.tolerance_margin)
    lines.push_back("stable for every error of components up to " + percent(*c.tolerance_margin) +
                    (c.margin_for_any_bandwidth ? ", whatever the bandwidths"
                     : c.margin_for_one_bandwidth
                         ? ", for op-amps of one bandwidth"
                         : ", if the op-amps are fast against the network"));
  else if (c.theorem.holds() && has_amplifiers(c.realization))
    lines.push_back("no margin for errors of components is proven: random builds and poles decide");
  std::string parts = elements_in_words(c.elements);
  if (c.greatest_ohm > 0.0)
    parts += "; resistors from " + brief(c.least_ohm) + " to " + brief(c.greatest_ohm) + " ohm";
  lines.push_back(parts);
  if (c.largest_voltage > 0.0)
    lines.push_back("largest voltage at rest " + brief(c.largest_voltage) + " V; " +
                    (c.power < 1.0 ? brief(1e3 * c.power) + " mW" : brief(c.power) + " W") +
                    " in the resistors");
  if (c.input_volts)
    lines.push_back("readings come as voltages, up to " + with_unit(*c.input_volts, "V") +
                    ", through resistors: errors that all resistors share cancel");
  for (const CircuitRemark& remark : c.remarks) lines.push_back("warning: " + in_words(remark));
  return lines;
}

std::string in_words(const lab::RelaxationRemark& remark) {
  using Kind = lab::RelaxationRemark::Kind;
  switch (remark.kind) {
    case Kind::no_load:
      return "there is no load: nothing to settle to, and nothing for components to change";
    case Kind::inaccurate:
      return "the circuit's answer is " + percent(remark.value) +
             " off the direct solve: not accurate, though its parts explain it";
    case Kind::stability_not_known:
      return "whether the circuit is stable is not known, and an operating point does not tell";
    case Kind::draws_without_opamps:
      return "draws of components are judged without the op-amps' dynamics, with which the circuit "
             "is not known to be stable";
    case Kind::settles_otherwise:
      return "ngspice's settling time is " + percent(remark.value) +
             " off the certificate's, which is for linear parts that start from zero: offsets, "
             "rails and curves are not in it";
    case Kind::nothing_takes_time:
      return "settling is asked for, and nothing here takes a time that is modelled: give the "
             "op-amps a bandwidth, opamp = { bandwidth = 10e6 }, or the nodes a capacitance, "
             "parasitic = { node = 1e-11 }";
    case Kind::tolerances_not_linear:
      return "tolerances are studied for networks of resistors and op-amps";
  }
  return {};
}

std::string in_words(const lab::Disagreement& d) {
  using Kind = lab::Disagreement::Kind;
  switch (d.kind) {
    case Kind::curves:
      return "node voltages are too large for the devices, whose curves may change the answer by " +
             brief(d.value) + " of itself: raise device_volts, or lower volts";
    case Kind::difference:
      return "the circuit differs from the direct solve by " + brief(d.value) + ", more than " +
             (d.explained.predicted ? "its op-amps (" + brief(*d.explained.predicted) + ") and "
                                    : "") +
             (d.explained.curves > 0.0 ? "its devices (" + brief(d.explained.curves) + ") and "
                                       : "") +
             "rounding explain (" + brief(d.explained.limit) + ")";
    case Kind::transient:
      return std::string("the certificate says ") + (d.value < 0.0 ? "stable" : "unstable") +
             ", the simulator's transient " + std::string(name(d.seen));
    case Kind::not_definite:
      return "P is not positive definite: the circuit would not settle";
    case Kind::unstable:
      return "the circuit is unstable: its slowest pole is at " + brief(d.value) + " 1/s";
    case Kind::draws:
      return "draws of components differ in the simulator by " + brief(d.value);
  }
  return {};
}

std::vector<std::string> warnings_of(const lab::Relaxation& relaxation) {
  std::vector<std::string> lines;
  if (relaxation.certificate)
    for (const CircuitRemark& remark : relaxation.certificate->remarks)
      lines.push_back(in_words(remark));
  for (const lab::RelaxationRemark& remark : relaxation.remarks) lines.push_back(in_words(remark));
  return lines;
}

std::vector<std::string> in_words(const lab::Relaxation& relaxation) {
  std::vector<std::string> lines;
  lines.push_back("ngspice against the direct solve of P f = b: " + brief(relaxation.difference) +
                  (!relaxation.agrees()    ? " (DIFFERS"
                   : relaxation.resolved() ? " (agrees"
                                           : " (NOT RESOLVED") +
                  (relaxation.explained.predicted ? "; the op-amps' gain and offset explain " +
                                                        brief(*relaxation.explained.predicted)
                                                  : "") +
                  (relaxation.explained.curves > 0.0
                       ? "; the devices' curves explain up to " + brief(relaxation.explained.curves)
                       : "") +
                  "; rounding explains up to " + brief(relaxation.explained.limit) + ")");
  if (relaxation.certificate) {
    for (const std::string& line : in_words(*relaxation.certificate)) lines.push_back(line);
  } else {
    const std::string settles =
        traits(relaxation.realization).parts == RealizationTraits::Parts::lossless
            ? " > 0; lossless: it rings for ever, and never settles"
            : " > 0: settles with capacitance at its nodes";
    lines.push_back("smallest eigenvalue of P: " + brief(relaxation.smallest_eigenvalue) +
                    (relaxation.stable ? settles : ": NOT positive definite, would not settle"));
  }
  if (relaxation.transient) lines.push_back(transient_in_words(relaxation));
  if (relaxation.tolerance) {
    const lab::ToleranceStudy& study = *relaxation.tolerance;
    for (const std::string& line : in_words(study.options, study.result)) lines.push_back(line);
    lines.push_back(std::to_string(study.replayed) +
                    " of these draws in ngspice: voltages agree to " + brief(study.difference));
  }
  for (const lab::RelaxationRemark& remark : relaxation.remarks)
    lines.push_back("warning: " + in_words(remark));
  lines.push_back("ngspice took " + duration(relaxation.ngspice_seconds) +
                  " for the operating point");
  return lines;
}

}  // namespace tactile_net::report
