// What real inputs and outputs do to a circuit at rest, and the scale that suits them.
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "network/output_current.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/network/static_errors.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

const RealizationOptions scaled{.scale = {.siemens = 2e-3, .volts = 3.0}};

double norm(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
}

StaticErrors errors_of(Realization one, const NetworkProblem& problem, const OpAmp& opamp,
                       const Scale& scale = scaled.scale) {
  return static_errors(FlatCircuit(realize(one, problem, {.scale = scale, .opamp = opamp})));
}

/// The rows' total conductance of a crossbar, in units of P.
std::vector<double> totals(const Matrix& matrix) {
  std::vector<double> result(matrix.rows);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (const double value : matrix.row(i)) result[i] += std::abs(value);
  return result;
}

}  // namespace

TEST_CASE("offsets of a crossbar err by P^-1 D v over the answer", "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const double offset = 50e-6;
  const StaticErrors errors =
      errors_of(Realization::crossbar, network.problem, {.gain = 1e9, .offset = offset});
  const std::vector<double> d = totals(network.problem.matrix);
  const double size = scaled.scale.volts * norm(network.direct);
  CHECK_THAT(errors.offset.alike,
             WithinRel(offset * norm(solve_symmetric(network.problem.matrix, d)) / size, 1e-5));
  double squares = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    std::vector<double> one(d.size());
    one[i] = d[i];
    squares += std::pow(norm(solve_symmetric(network.problem.matrix, one)), 2);
  }
  CHECK_THAT(errors.offset.either_sign, WithinRel(offset * std::sqrt(squares) / size, 1e-5));
}

TEST_CASE("bias currents of a crossbar err by P^-1 i over the answer", "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const double bias = 1e-9;
  const StaticErrors errors =
      errors_of(Realization::crossbar, network.problem, {.gain = 1e9, .bias_current = bias});
  const std::vector<double> ones(21, 1.0);
  CHECK_THAT(errors.bias_current.alike,
             WithinRel(bias * norm(solve_symmetric(network.problem.matrix, ones)) /
                           (scaled.scale.siemens * scaled.scale.volts * norm(network.direct)),
                       1e-5));
}

TEST_CASE("errors at rest are those of the operating point, and as signs by chance draw them",
          "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const auto at = [&](const OpAmp& opamp) {
      return operating_voltages(
          FlatCircuit(realize(one, network.problem, {.scale = scaled.scale, .opamp = opamp})));
    };
    const OpAmp exact{.gain = 1e7};
    const std::vector<double> answer = at(exact);
    const auto moved = [&](const OpAmp& opamp) {
      std::vector<double> v = at(opamp);
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= answer[i];
      return norm(v) / norm(answer);
    };
    const OpAmp opamp{.gain = 1e7,
                      .offset = -1e-4,
                      .bias_current = 1e-8,
                      .common_mode_rejection = 1e4,
                      .output_resistance = 50.0};
    const StaticErrors errors = errors_of(one, network.problem, opamp);
    CHECK_THAT(errors.offset.alike, WithinRel(moved({.gain = 1e7, .offset = -1e-4}), 0.02));
    CHECK_THAT(errors.bias_current.alike,
               WithinRel(moved({.gain = 1e7, .bias_current = 1e-8}), 0.02) || WithinAbs(0.0, 1e-7));
    // Inputs at ground, and those of a lattice, have no voltage in common.
    if (traits(one).drives_nodes)
      CHECK(errors.common_mode < 1e-8);
    else
      CHECK(errors.common_mode > 1e-6);
    // Inside a loop of that gain.
    CHECK(errors.output_resistance < 1e-3);
    CHECK(errors.output_resistance > 0.0);

    // Signs by chance: the mean square over all of them is what each op-amp adds alone.
    Circuit drawn = FlatCircuit(realize(one, network.problem, {.scale = scaled.scale})).circuit();
    const std::string model = drawn.amplifiers.front().name;
    const Outputs outputs = drawn.amplifiers.front().outputs;
    double squares = 0.0;
    for (std::size_t k = 0; k < drawn.instances.size(); ++k) {
      Circuit alone = drawn;
      alone.amplifiers = {{model, exact, outputs}, {"odd", exact, outputs}};
      alone.amplifiers[1].opamp.offset = 1e-4;
      alone.instances[k].subcircuit = "odd";
      std::vector<double> v = operating_voltages(FlatCircuit(alone));
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= answer[i];
      squares += std::pow(norm(v) / norm(answer), 2);
    }
    CHECK_THAT(errors.offset.either_sign, WithinRel(std::sqrt(squares), 0.02));
  }
}

TEST_CASE("errors at rest fall as one over the volts, bias currents' over the siemens too",
          "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  const OpAmp opamp{.gain = 1e8, .offset = 1e-3, .bias_current = 1e-8};
  const StaticErrors one = errors_of(Realization::lattice, network.problem, opamp, {1e-3, 1.0});
  const StaticErrors ten = errors_of(Realization::lattice, network.problem, opamp, {1e-2, 10.0});
  CHECK_THAT(one.offset.either_sign / ten.offset.either_sign, WithinRel(10.0, 1e-4));
  CHECK_THAT(one.bias_current.either_sign / ten.bias_current.either_sign, WithinRel(100.0, 1e-4));
  CHECK(one.common_mode == 0.0);
  CHECK(one.output_resistance == 0.0);
}

TEST_CASE("equations at rest and over time agree on every real input and output",
          "[opamp_errors][state_space]") {
  const ArrayNetwork network = array_network(7, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice})
    for (const bool inverters : {false, true}) {
      if (inverters && !traits(one).drives_nodes) continue;
      for (const bool capacitance : {false, true}) {
        CAPTURE(name(one), inverters, capacitance);
        OpAmp opamp{.gain = 1e5,
                    .bandwidth = 1e7,
                    .second_pole = 3e7,
                    .offset = 1e-3,
                    .bias_current = -2e-8,
                    .common_mode_rejection = 1e3,
                    .output_resistance = 100.0};
        if (capacitance) opamp.input_capacitance = 1e-12;
        const FlatCircuit circuit(realize(
            one, network.problem, {.scale = {1e-3, 1.0}, .opamp = opamp, .inverters = inverters}));
        const std::vector<double> rest = operating_voltages(circuit);
        const std::vector<double> end = steady_state(state_space(circuit));
        for (std::size_t i = 0; i < rest.size(); ++i)
          CHECK_THAT(end[i], WithinAbs(rest[i], 1e-7 * norm(rest)));
      }
    }
}

TEST_CASE("an output resistance takes from the amplifier what its load draws",
          "[opamp_errors][state_space]") {
  // One amplifier with two outputs: 1 kilo-ohm from each to ground, 2 kilo-ohm between them.
  Circuit circuit;
  const Node s = add_node(circuit, "s0");
  const Node out = add_node(circuit, "n0");
  const Node inverse = add_node(circuit, "r0");
  circuit.outputs = {out};
  circuit.amplifiers = {{"amplifier",
                         {.gain = 100.0, .bandwidth = 1e6, .output_resistance = 50.0},
                         Outputs::complementary}};
  circuit.instances = {{"X0", {0, s, out, inverse}, "amplifier"}};
  circuit.resistors = {{"R0", s, out, 1e-6},
                       {"R1", out, 0, 1e-3},
                       {"R2", inverse, 0, 1e-3},
                       {"R3", out, inverse, 0.5e-3}};
  circuit.sources = {{"I0", s, 1e-6}};
  // s = v + 1 V, core = -100 s. Half the difference of what the outputs give off: 2 mS v, and half
  // of the -1 uA that R0 takes from one of them.
  const double load = 50.0 * 2e-3;
  const double feedback = 50.0 * 0.5 * -1e-6;
  // v = -100 (1 + v) - load v - feedback
  const double v = (-100.0 - feedback) / (1.0 + 100.0 + load);
  CHECK_THAT(operating_voltages(FlatCircuit(circuit))[0], WithinRel(v, 1e-12));
  CHECK_THAT(steady_state(state_space(circuit))[0], WithinRel(v, 1e-12));
}

TEST_CASE("a certificate proposes the scale at which its own numbers are what it says",
          "[opamp_errors][certificate]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  RealizationOptions options{
      .opamp = {
          .gain = 1e6, .bandwidth = 1e7, .offset = 5e-5, .rail = 12.0, .noise_voltage = 5e-9}};
  const auto said = [&] { return certify(Realization::crossbar, network.problem, options); };
  const Certificate before = said();
  REQUIRE(before.proposal);
  const ScaleProposal& proposal = *before.proposal;
  CHECK(proposal.volts_by == ScaleProposal::Bound::swing);
  CHECK(proposal.noise < before.noise->relative);
  options.scale = {proposal.siemens, proposal.volts};
  const Certificate after = said();
  CHECK_THAT(after.noise->relative, WithinRel(proposal.noise, 1e-3));
  CHECK_THAT(after.noise->thermal, WithinRel(0.5, 1e-3));
  CHECK_THAT(after.errors->offset.either_sign, WithinRel(proposal.offset, 1e-3));
  CHECK(after.largest_voltage <= 0.81 * 11.4);
  // The scale that it is at by then: it asks for no other.
  CHECK_THAT(after.proposal->volts, WithinRel(proposal.volts, 1e-6));
  CHECK_THAT(after.proposal->siemens, WithinRel(proposal.siemens, 1e-2));

  options.opamp.rail.reset();
  options.scale = {};
  // No rail is stated: no more than amplifiers of 5 V in all give.
  CHECK(said().proposal->volts_by == ScaleProposal::Bound::supply);
  CHECK(said().proposal->volts * said().largest_voltage <= 2.0 * options.scale.volts * 1.001);
  options.opamp.slew = 1e6;
  CHECK(said().proposal->volts_by == ScaleProposal::Bound::slew);
  options.opamp = {.gain = 1e6, .bandwidth = 1e7};
  CHECK_FALSE(said().proposal);
  CHECK_FALSE(said().errors);
}

TEST_CASE("op-amps are in every build, each with errors of its own", "[opamp_errors][tolerance]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(9, 1e-3).problem);
  const Realization one = GENERATE(Realization::nic, Realization::crossbar,
                                   Realization::least_squares, Realization::lattice);
  CAPTURE(name(one));
  const NetworkCircuit circuit(one, problem,
                               {.opamp = {.gain = 1e4,
                                          .bandwidth = 1e7,
                                          .offset = 2e-3,
                                          .common_mode_rejection = 1e3,
                                          .output_resistance = 100.0}});
  const Reduction& reduction = circuit.reduction();
  // By circuits of which one op-amp alone has an offset, and one of which none has.
  Circuit none = circuit.flat().circuit();
  std::vector<AmplifierModel> models = none.amplifiers;
  for (AmplifierModel& model : none.amplifiers) model.opamp.offset.reset();
  const std::vector<double> base = operating_voltages(FlatCircuit(none));
  const std::size_t outputs = base.size();
  double squares = 0.0;
  for (std::size_t k = 0; k < none.instances.size(); ++k) {
    Circuit alone = none;
    for (const AmplifierModel& model : models)
      if (model.name == none.instances[k].subcircuit)
        alone.amplifiers.push_back({"own", model.opamp, model.outputs});
    alone.instances[k].subcircuit = "own";
    const std::vector<double> moved = operating_voltages(FlatCircuit(alone));
    for (std::size_t i = 0; i < outputs; ++i) squares += std::pow(moved[i] - base[i], 2);
  }
  std::vector<double> off = array_network(9, 1e-3).direct;
  const double size = norm(off);
  for (std::size_t i = 0; i < outputs; ++i) off[i] = base[i] - off[i];
  const double expected = std::sqrt(squares + std::pow(norm(off), 2)) / size;

  const std::vector<Load> loads = {circuit.circuit().sources};
  const LoadedNetwork built(reduction, loads, {opamp_errors(circuit.flat(), loads), 0.0});
  const OpAmpShares alone = built.opamp_shares();
  CHECK_THAT(alone.offset, WithinRel(std::sqrt(squares) / size, 1e-5));
  CHECK_THAT(alone.total, WithinRel(expected, 1e-5));
  CHECK(alone.balance == 0.0);

  const auto mean_square = [](const std::vector<double>& errors) {
    return std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) /
           static_cast<double>(errors.size());
  };
  const ResistorErrors exact(std::vector<double>(reduction.resistors().size()));
  const std::vector<double> drawn = built.builds(reduction.siemens(), exact, 1000, 3);
  CHECK_THAT(std::sqrt(mean_square(drawn)), WithinRel(expected, 0.1));
  // The yield of a certificate counts them in the same way.
  const ToleranceResult yield =
      tolerate(circuit, {.relative = 1e-6, .trials = 1000, .accuracy = 0.5 * expected});
  CHECK_THAT(yield.predicted, WithinRel(expected, 1e-3));
  CHECK_THAT(std::sqrt(mean_square(yield.errors)), WithinRel(expected, 0.1));
  CHECK(yield.yield() < 0.5);
}

TEST_CASE("what op-amps do not have moves an answer by nothing at all", "[opamp_errors]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one :
       {Realization::nic, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    OpAmp opamp{.gain = 1e4, .bandwidth = 1e7, .second_pole = 2.5e7, .offset = 1e-3};
    const auto shift_of = [&](const OpAmp& own) {
      const Circuit circuit = realize(one, network.problem, {.opamp = own});
      const std::vector<std::vector<CurrentSource>> load = {circuit.sources};
      return opamp_errors(circuit, load).shifts.at(0);
    };
    const OpAmpErrors::Shift plain = shift_of(opamp);
    CHECK(norm(plain.gain) > 0.0);
    CHECK(norm(plain.common_mode) == 0.0);
    CHECK(norm(plain.output_resistance) == 0.0);
    opamp.common_mode_rejection = 1e3;
    CHECK(norm(shift_of(opamp).common_mode) > 0.0);
    CHECK(norm(shift_of(opamp).output_resistance) == 0.0);
  }
}

TEST_CASE("balance in a build is what it is in a draw", "[opamp_errors][tolerance]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  const Circuit circuit = realize(Realization::lattice, network.problem);
  const Reduction reduction(circuit);
  const std::vector<Load> loads = {circuit.sources};
  const LoadedNetwork built(reduction, loads, {{}, 1e-3});
  const double predicted = tolerate(reduction, {.balance = 1e-3, .trials = 1}).predicted;
  CHECK_THAT(built.opamp_shares().balance, WithinRel(predicted, 1e-9));
  CHECK_THAT(built.opamp_shares().total, WithinRel(predicted, 1e-9));
  const ResistorErrors exact(std::vector<double>(reduction.resistors().size()));
  const std::vector<double> errors = built.builds(reduction.siemens(), exact, 50, 1);
  const ToleranceResult drawn = tolerate(reduction, {.balance = 1e-3, .trials = 50, .seed = 1});
  for (std::size_t k = 0; k < errors.size(); ++k)
    CHECK_THAT(errors[k], WithinRel(drawn.errors[k], 1e-9));
}

TEST_CASE("a certificate knows what outputs carry, and names the one that carries too much",
          "[opamp_errors][certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    RealizationOptions options{.scale = scaled.scale,
                               .opamp = {.gain = 1e8, .bandwidth = 1e7, .output_current = 1.0}};
    const Certificate weak = certify(one, network.problem, options);
    REQUIRE(weak.output_current);
    const double carried = weak.output_current->largest;
    CHECK(carried > 0.0);
    CHECK(weak.remarks.empty());
    // In proportion to volts and, where no divider draws its own, to siemens.
    options.scale.volts *= 2.0;
    CHECK_THAT(certify(one, network.problem, options).output_current->largest,
               WithinRel(2.0 * carried, 1e-6));
    options.opamp.output_current = carried;
    const Certificate strong = certify(one, network.problem, options);
    REQUIRE(strong.remarks.size() == 1);
    CHECK(strong.remarks[0].kind == CircuitRemark::Kind::output_current);
    CHECK(strong.remarks[0].part == strong.output_current->opamp);
    CHECK_THAT(strong.remarks[0].repair, WithinRel(scaled.scale.volts, 1e-6));
    options.scale.volts = strong.remarks[0].repair * 0.999;
    CHECK(certify(one, network.problem, options).remarks.empty());
    options.opamp.output_current.reset();
    CHECK_FALSE(certify(one, network.problem, options).output_current);
  }
}

TEST_CASE("an amplifier carries its load's current and its feedback's", "[opamp_errors]") {
  // -1 V from 1 mA into 1 kilo-ohm; 250 ohm from the output to ground: 4 mA, and the 1 mA.
  Circuit circuit;
  const Node s = add_node(circuit, "s0");
  const Node out = add_node(circuit, "n0");
  circuit.outputs = {out};
  circuit.amplifiers = {{"opamp", {.gain = 1e12}, Outputs::single}};
  circuit.instances = {{"X0", {0, s, out}, "opamp"}};
  circuit.resistors = {{"R0", s, out, 1e-3}, {"R1", out, 0, 4e-3}};
  circuit.sources = {{"I0", s, 1e-3}};
  const OutputCurrent carried = output_current(FlatCircuit(circuit));
  CHECK_THAT(carried.largest, WithinRel(5e-3, 1e-9));
  CHECK(carried.opamp == "X0");
}

TEST_CASE("a scale is proposed at which outputs carry no more than they can",
          "[opamp_errors][certificate]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  RealizationOptions options{.opamp = {.gain = 1e6,
                                       .bandwidth = 1e7,
                                       .offset = 5e-5,
                                       .rail = 12.0,
                                       .noise_voltage = 5e-9,
                                       .output_current = 1e-3}};
  const Certificate before = certify(Realization::lattice, network.problem, options);
  REQUIRE(before.proposal);
  CHECK(before.proposal->volts_by == ScaleProposal::Bound::current);
  options.scale = {before.proposal->siemens, before.proposal->volts};
  const Certificate after = certify(Realization::lattice, network.problem, options);
  CHECK_THAT(after.output_current->largest, WithinRel(1e-3, 1e-2));
  CHECK_THAT(after.noise->relative, WithinRel(before.proposal->noise, 1e-3));
}

TEST_CASE("no scale is proposed at which strays would make the circuit grow",
          "[opamp_errors][certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  RealizationOptions options{.scale = {.siemens = 1e-2},
                             .opamp = {.gain = 1e6,
                                       .bandwidth = 1e7,
                                       .second_pole = 2.5e7,
                                       .input_capacitance = 12e-12,
                                       .noise_voltage = 30e-9},
                             .node_capacitance = 20e-12};
  const auto said = [&] { return certify(Realization::lattice, network.problem, options); };
  const Certificate before = said();
  REQUIRE(before.stability == Stability::stable);
  REQUIRE(before.proposal);
  options.scale.volts = before.proposal->volts;
  options.scale.siemens = before.proposal->siemens;
  const Certificate after = said();
  CHECK(after.stability == Stability::stable);
  CHECK_THAT(after.noise.value().relative, WithinRel(before.proposal->noise, 1e-2));
  // What the op-amps' noise alone would ask for: the resistors' is a small part of it.
  CHECK(before.noise->thermal < 0.1);
  options.scale.siemens = 1e-2 * before.noise->thermal / (1.0 - before.noise->thermal);
  const Certificate smaller = said();
  CHECK(smaller.stability == Stability::unstable);
  CHECK_FALSE(smaller.proposal);
}

TEST_CASE("fewer siemens are proposed only where the circuit rings no more for them",
          "[opamp_errors][certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  std::size_t fewer = 0;
  std::size_t kept = 0;
  for (const double stray : {0.5e-12, 2e-12, 6e-12, 12e-12, 20e-12, 30e-12}) {
    CAPTURE(stray);
    RealizationOptions options{.scale = {.siemens = 5e-2},
                               .opamp = {.gain = 1e6,
                                         .bandwidth = 5e6,
                                         .second_pole = 1.8e7,
                                         .input_capacitance = 0.5 * stray,
                                         .noise_voltage = 4e-9},
                               .node_capacitance = stray};
    const Certificate before = certify(Realization::lattice, network.problem, options);
    REQUIRE(before.stability == Stability::stable);
    REQUIRE(before.proposal);
    if (before.proposal->siemens >= options.scale.siemens) {
      ++kept;
      continue;
    }
    ++fewer;
    options.scale.siemens = before.proposal->siemens;
    const Certificate after = certify(Realization::lattice, network.problem, options);
    CHECK(after.dynamics.value().damping >= std::min(0.7, before.dynamics.value().damping) - 1e-9);
  }
  CHECK(fewer > 0);
  CHECK(kept > 0);
}

TEST_CASE("a theorem that does not know output resistances says so", "[opamp_errors][theorem]") {
  const ArrayNetwork network = array_network(7, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const OpAmp opamp{.gain = 1e6, .bandwidth = 1e7, .output_resistance = 50.0};
    const Certificate c = certify(one, network.problem, {.opamp = opamp});
    CHECK(c.theorem.unmet.value().condition == TheoremCondition::no_output_resistance);
    CHECK_FALSE(c.tolerance_margin);
    CHECK(c.stability == Stability::stable);  // by its poles
  }
  const Certificate c =
      certify(Realization::nic, network.problem,
              {.opamp = {.gain = 1e6, .bandwidth = 1e7, .common_mode_rejection = 1e4}});
  CHECK(c.theorem.unmet.value().condition == TheoremCondition::no_common_mode_error);
}

TEST_CASE("op-amps of every class in problems on the edge: finite numbers, or a verdict",
          "[opamp_errors][certificate]") {
  std::vector<NetworkProblem> edges = {
      array_network(2, 1e-3).problem, array_network(9, 1e-8).problem,
      array_network(9, 1e-3).problem, array_network(9, 1e-3, 2).problem,
      array_network(9, 1e-3).problem};
  for (std::size_t j = 0; j < 9; ++j) edges[2].kernel(4, j) = 0.0;  // a dead taxel
  for (std::size_t i = 0; i < 9; ++i) edges[4].kernel(i, 4) = 0.0;  // a traction nobody sees
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (const OpAmpClass& kind : opamp_classes())
      for (const Realization one :
           {Realization::crossbar, Realization::least_squares, Realization::lattice})
        for (const double farad : {1e-15, 1e-9}) {
          CAPTURE(k, kind.name, name(one), farad);
          RealizationOptions options{.opamp = kind.opamp};
          options.opamp.input_capacitance = farad;
          const Certificate c = certify(one, edges[k], options);
          REQUIRE(c.dynamics);
          REQUIRE(c.errors);
          CHECK(std::isfinite(c.errors->offset.either_sign));
          CHECK(c.errors->offset.either_sign > 0.0);
          CHECK(c.errors->bias_current.either_sign > 0.0);
          const bool stable = c.stability == Stability::stable;
          CHECK(stable == (c.dynamics->slowest < 0.0));
          CHECK(c.noise.has_value() == stable);
          if (!stable) continue;
          CHECK(c.noise->relative > 0.0);
          REQUIRE(c.proposal);
          CHECK(c.proposal->volts > 0.0);
          CHECK(std::isfinite(c.proposal->siemens));
        }
}

TEST_CASE("what an op-amp cannot have is refused", "[opamp_errors]") {
  CHECK_THROWS_AS(check(OpAmp{.slew = 1e6}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.bandwidth = 1e6, .slew = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.noise_current = 1e-12}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.gain = 1e6, .output_resistance = -1.0}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.gain = 1e6, .output_current = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.gain = 1e6, .common_mode_rejection = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.bias_current = INFINITY}), std::invalid_argument);
  for (const OpAmpClass& one : opamp_classes()) CHECK_NOTHROW(check(one.opamp));
}
