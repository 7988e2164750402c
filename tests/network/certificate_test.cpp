#include "tactile_net/network/certificate.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

using Kind = CircuitRemark::Kind;

NetworkProblem indefinite() {
  NetworkProblem problem = array_network(11, 1e-3).problem;
  const double shift = smallest_eigenvalue(problem.matrix) + 1e-4;
  for (std::size_t i = 0; i < 11; ++i) problem.matrix(i, i) -= shift;
  return problem;
}

}  // namespace

TEST_CASE("a definite P is certified by the theorem of its realisation", "[certificate]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const Certificate c = certify(one, network.problem, {.opamp = one_pole});
    CHECK(c.stability == Stability::stable);
    CHECK(c.theorem.holds());
    REQUIRE(c.dynamics);
    CHECK(c.dynamics->slowest < 0.0);
    CHECK(c.dynamics->poles.size() == c.dynamics->states);
    CHECK(c.dynamics->poles.front().real() == c.dynamics->slowest);
    CHECK(c.dynamics->settling_seconds.value() > 0.0);
    CHECK(c.tolerance_margin.value() > 0.0);
    CHECK(c.remarks.empty());
    CHECK(c.power > 0.0);
    CHECK(c.largest_voltage > 0.3);
  }
}

TEST_CASE("no realisation of an indefinite P is certified", "[certificate]") {
  const NetworkProblem problem = indefinite();
  for (const Realization one :
       {Realization::ideal, Realization::nic, Realization::rail, Realization::crossbar}) {
    CAPTURE(name(one));
    const Certificate c = certify(one, problem, {.opamp = one_pole, .node_capacitance = 1e-11});
    CHECK(c.stability == Stability::not_definite);
    REQUIRE(c.theorem.unmet);
    CHECK(c.theorem.unmet->condition == TheoremCondition::definite);
    CHECK_FALSE(c.tolerance_margin);
    CHECK(std::isinf(c.condition));
    REQUIRE(c.dynamics);
    CHECK(c.dynamics->slowest > 0.0);
    CHECK_FALSE(c.dynamics->settling_seconds);
    CHECK(c.dynamics->mode.size() == 11);
  }
}

TEST_CASE("a rule that is broken comes with the number that mends it", "[certificate]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const auto remarks = [&](Realization one, const RealizationOptions& options) {
    return certify(one, network.problem, options).remarks;
  };
  OpAmp with_rail = one_pole;
  with_rail.rail = 2.0;
  RealizationOptions clamped{.scale = {.volts = 10.0}, .opamp = with_rail};
  const auto clamps = remarks(Realization::crossbar, clamped);
  REQUIRE(clamps.size() == 1);
  CHECK(clamps[0].kind == Kind::clamps);
  CHECK_THAT(clamps[0].limit, WithinRel(1.4, 1e-12));
  CHECK(clamps[0].value > clamps[0].limit);
  clamped.scale.volts = clamps[0].repair;
  CHECK(remarks(Realization::crossbar, clamped).empty());

  OpAmp with_input = one_pole;
  with_input.input_capacitance = 1e-11;
  RealizationOptions ringing{.opamp = with_input};
  const auto rings = remarks(Realization::nic, ringing);
  REQUIRE(rings.size() == 1);
  CHECK(rings[0].kind == Kind::divider_rings);
  CHECK(rings[0].value == ringing.divider);
  ringing.divider = rings[0].repair;
  CHECK(remarks(Realization::nic, ringing).empty());

  RealizationOptions loaded{.opamp = with_input, .node_capacitance = 1e-12};
  const auto counts = remarks(Realization::least_squares, loaded);
  REQUIRE(counts.size() == 2);
  CHECK(counts[0].kind == Kind::capacitance_at_outputs);
  CHECK(counts[1].kind == Kind::summing_lag);
  CHECK(counts[1].repair > loaded.scale.siemens);
  CHECK(remarks(Realization::lc, {.node_capacitance = 1e-12}).front().kind ==
        Kind::capacitance_at_one_frequency);
}

TEST_CASE("a network that needs no op-amp has no dynamics, and no crash", "[certificate]") {
  NetworkProblem problem;
  problem.matrix = {2, 2, {2, -1, -1, 2}};
  problem.right_side = {1, 0};
  const Certificate c = certify(Realization::nic, problem, {.opamp = one_pole});
  CHECK_FALSE(c.dynamics);
  CHECK(c.elements.opamps == 0);
  CHECK(c.stability == Stability::stable);
}

TEST_CASE("only amplifiers can be slow", "[certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  OpAmp two_poles = one_pole;
  two_poles.second_pole = 2e7;
  CHECK(
      certify(Realization::ideal, network.problem, {.opamp = two_poles}).margin_for_any_bandwidth);
  CHECK(certify(Realization::crossbar, network.problem, {}).margin_for_any_bandwidth);
  CHECK_FALSE(
      certify(Realization::nic, network.problem, {.opamp = one_pole}).margin_for_any_bandwidth);
}

TEST_CASE("beside second poles and capacitance no margin is proven", "[certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  OpAmp two_poles = one_pole;
  two_poles.second_pole = 2e7;
  OpAmp with_input = one_pole;
  with_input.input_capacitance = 1e-13;
  for (const Realization one : {Realization::nic, Realization::crossbar, Realization::lattice})
    for (const OpAmp& opamp : {two_poles, with_input}) {
      CAPTURE(name(one));
      const Certificate c = certify(one, network.problem, {.opamp = opamp});
      CHECK(c.theorem.holds());
      CHECK_FALSE(c.tolerance_margin);
      CHECK_FALSE(c.margin_for_any_bandwidth);
    }
  const Certificate c = certify(Realization::lattice, network.problem,
                                {.opamp = one_pole, .node_capacitance = 1e-12});
  CHECK(c.theorem.holds());
  CHECK_FALSE(c.tolerance_margin);
}

TEST_CASE("an eigenvalue that rounding made proves nothing", "[certificate]") {
  for (const double alpha : {1e-6, 1e-9, 1e-12, 1e-18}) {
    CAPTURE(alpha);
    const Certificate c = certify(Realization::ideal, array_network(41, alpha).problem, {});
    if (c.tolerance_margin) CHECK(*c.tolerance_margin < 50.0 * c.smallest_eigenvalue);
  }
  NetworkProblem singular;
  singular.matrix = {2, 2, {1, -1, -1, 1 + 1e-16}};
  singular.right_side = {1, -1};
  CHECK(certify(Realization::crossbar, singular, {.opamp = one_pole}).stability ==
        Stability::not_definite);
}

TEST_CASE("what nobody could buy is said, with another scale", "[certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  const Certificate c =
      certify(Realization::crossbar, network.problem, {.scale = {.siemens = 1e-9, .volts = 1e4}});
  REQUIRE(c.remarks.size() == 2);
  CHECK(c.remarks[0].kind == Kind::not_for_sale);
  CHECK(c.remarks[1].kind == Kind::odd_voltage);
  const Scale better{.siemens = c.remarks[0].repair, .volts = c.remarks[1].repair};
  const Certificate mended = certify(Realization::crossbar, network.problem, {.scale = better});
  CHECK(mended.remarks.empty());
  CHECK_THAT(mended.largest_voltage, WithinRel(1.0, 1e-9));
  CHECK_THAT(mended.least_ohm * mended.greatest_ohm, WithinRel(1e10, 1e-9));
}

TEST_CASE("what the certificate proposes against capacitance settles", "[certificate]") {
  const ArrayNetwork network = array_network(21, 1e-6);
  OpAmp opamp = one_pole;
  opamp.input_capacitance = 1e-12;
  RealizationOptions options{.opamp = opamp, .residual_gain = 100.0};
  const Certificate bad = certify(Realization::least_squares, network.problem, options);
  CHECK(bad.stability == Stability::unstable);
  CHECK_FALSE(bad.theorem.holds());
  REQUIRE(bad.remarks.size() == 1);
  CHECK(bad.remarks[0].kind == Kind::summing_lag);
  options.scale.siemens = bad.remarks[0].repair;
  CHECK(certify(Realization::least_squares, network.problem, options).stability ==
        Stability::stable);
}

TEST_CASE("conditions of theorems are checked one by one", "[certificate]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const auto unmet = [&](Realization one, const RealizationOptions& options) {
    return certify(one, network.problem, options).theorem.unmet;
  };
  OpAmp two_poles = one_pole;
  two_poles.second_pole = 2e7;
  OpAmp with_input = one_pole;
  with_input.input_capacitance = 1e-12;
  using enum TheoremCondition;
  CHECK_FALSE(unmet(Realization::nic, {.opamp = two_poles}));
  CHECK_FALSE(unmet(Realization::nic, {.opamp = with_input, .divider = 7.9e3}));
  CHECK(unmet(Realization::nic, {.opamp = with_input, .divider = 8e3}).value().condition ==
        divider_fast_enough);
  CHECK_FALSE(unmet(Realization::crossbar, {.opamp = two_poles}));
  OpAmp both = with_input;
  both.second_pole = 1e7;
  CHECK_FALSE(unmet(Realization::crossbar, {.opamp = both}));
  CHECK(unmet(Realization::nic, {.opamp = both, .divider = 100.0}).value().condition ==
        divider_fast_enough);
  both.second_pole = 0.99e7;
  CHECK(unmet(Realization::crossbar, {.opamp = both}).value().condition ==
        second_pole_beyond_bandwidth);
  CHECK(unmet(Realization::least_squares, {.opamp = two_poles}).value().condition ==
        lag_within_bound);
  CHECK_FALSE(unmet(Realization::lattice, {.opamp = two_poles}));
  CHECK_FALSE(unmet(Realization::lattice, {.opamp = one_pole, .node_capacitance = 1e-9}));
  CHECK(unmet(Realization::lattice, {.opamp = two_poles, .node_capacitance = 1e-9})
            .value()
            .condition == one_lag);
  CHECK_FALSE(unmet(Realization::lattice, {.opamp = with_input}));
  both.second_pole = 2e7;
  CHECK_FALSE(unmet(Realization::lattice, {.opamp = both}));
  both.second_pole = 1.99e7;
  CHECK(unmet(Realization::lattice, {.opamp = both}).value().condition ==
        second_pole_beyond_twice_bandwidth);
  CHECK_FALSE(unmet(Realization::lattice, {.opamp = both, .bandwidth_ratio = 0.99}));
  CHECK(unmet(Realization::rail, {.opamp = with_input}).value().condition == no_input_capacitance);
  CHECK(unmet(Realization::lattice, {.opamp = one_pole, .inverters = true}).value().condition ==
        complementary_outputs);
  CHECK_FALSE(unmet(Realization::crossbar, {.opamp = with_input}));
  CHECK(unmet(Realization::crossbar, {.opamp = with_input, .inverters = true}).value().condition ==
        no_inverter_input_capacitance);
  const auto fast =
      unmet(Realization::crossbar, {.opamp = one_pole, .inverters = true, .bandwidth_ratio = 0.75});
  CHECK(fast.value().condition == main_at_most_half_of_inverters);
  CHECK(fast->bandwidth_ratio == 0.75);
  CHECK(
      unmet(Realization::least_squares, {.opamp = one_pole, .inverters = true}).value().condition ==
      main_slow_enough);
}

TEST_CASE("a certificate is the same whoever made the circuit", "[certificate]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(11, 1e-3).problem);
  for (const Realization one : realizations) {
    CAPTURE(name(one));
    const RealizationOptions options{.opamp = one_pole, .node_capacitance = 1e-11};
    const NetworkCircuit circuit(one, problem, options);
    const Certificate mine = certify(circuit);
    const Certificate its = certify(one, *problem, options);
    CHECK(mine.stability == its.stability);
    CHECK(mine.power == its.power);
    CHECK(mine.tolerance_margin == its.tolerance_margin);
    REQUIRE(mine.dynamics.has_value() == its.dynamics.has_value());
    if (mine.dynamics) CHECK(mine.dynamics->poles == its.dynamics->poles);
    CHECK(&circuit.flat() == &circuit.flat());
  }
}

TEST_CASE("a circuit that is too large for its poles, and of no theorem, is not called stable",
          "[certificate][stability]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(41, 1e-3).problem);
  OpAmp opamp = one_pole;
  opamp.second_pole = 2.5e7;
  opamp.input_capacitance = 4e-12;
  const NetworkCircuit circuit(Realization::nic, problem, {.opamp = opamp});
  REQUIRE(count_states(circuit.flat()) > most_states);
  const StabilityVerdict verdict = stability_of(circuit);
  CHECK(verdict.stability == Stability::not_modelled);
  CHECK(verdict.unknown == UnknownStability::too_many_states);
}

TEST_CASE("stability alone is the certificate's, with everything that is stated",
          "[certificate][stability]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(9, 1e-3).problem);
  OpAmp real = one_pole;
  real.second_pole = 2e7;
  real.input_capacitance = 1e-11;
  for (const Realization one : realizations)
    for (const OpAmp& opamp : {OpAmp{}, real})
      for (const bool ladder : {false, true}) {
        if (ladder && one != Realization::least_squares) continue;
        CAPTURE(name(one), ladder, opamp.second_pole.has_value());
        const NetworkCircuit circuit(one, problem,
                                     {.opamp = opamp, .ladder = ladder, .node_capacitance = 2e-11});
        const StabilityVerdict verdict = stability_of(circuit);
        const Certificate c = certify(circuit);
        CHECK(verdict.stability == c.stability);
        CHECK(verdict.unknown == c.unknown);
        CHECK(verdict.unknown.has_value() == (c.stability == Stability::not_modelled));
        if (takes_time(one, circuit.options()))
          CHECK((verdict.stability == Stability::stable) ==
                (poles(state_space(circuit.flat())).front().real() < 0.0));
      }
}

TEST_CASE("capacitance at outputs that have a resistance is a pole in every loop",
          "[certificate][stability]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(9, 1e-3).problem);
  OpAmp opamp = one_pole;
  opamp.output_resistance = 150.0;
  const double farad = 5e-10;
  const auto kinds = [](const Certificate& c) {
    std::vector<Kind> all;
    for (const CircuitRemark& remark : c.remarks) all.push_back(remark.kind);
    return all;
  };
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice})
    for (const bool inverters : {false, true}) {
      CAPTURE(name(one), inverters);
      RealizationOptions options{.opamp = opamp, .inverters = inverters, .node_capacitance = {}};
      if (!traits(one).drives_nodes) options.node_capacitance = 1e-11;
      const NetworkCircuit unloaded(one, problem, options);
      CHECK(kinds(certify(unloaded)) == std::vector<Kind>{Kind::outputs_without_load});

      options.opamp.load_capacitance = farad;
      const NetworkCircuit loaded(one, problem, options);
      const Certificate c = certify(loaded);
      CHECK(kinds(c).empty());
      // The same by capacitors at each output, converters' and inverters' too.
      Circuit lines = unloaded.flat().circuit();
      for (const Instance& x : lines.instances)
        for (std::size_t pin = 2; pin < x.pins.size(); ++pin)
          lines.capacitors.push_back({"C" + lines.nodes[x.pins[pin]], x.pins[pin], 0, farad});
      const std::vector<std::complex<double>> expected = poles(state_space(lines));
      REQUIRE(c.dynamics.value().poles.size() == expected.size());
      CHECK_THAT(c.dynamics->slowest,
                 WithinAbs(expected.front().real(), 1e-9 * std::abs(expected.back())));
      CHECK((c.stability == Stability::stable) == (expected.front().real() < 0.0));
      CHECK(std::abs(c.dynamics->slowest / unloaded.poles().front().real() - 1.0) > 1e-2);

      // Where the nodes are outputs their capacitance is a load.
      if (!has_nodes_at_outputs(one, options)) continue;
      options.opamp.load_capacitance.reset();
      options.node_capacitance = farad;
      CHECK(certify(one, *problem, options).dynamics->slowest == c.dynamics->slowest);
      // Without a resistance it does nothing.
      options.opamp.output_resistance.reset();
      const Certificate stiff = certify(one, *problem, options);
      CHECK(kinds(stiff) == std::vector<Kind>{Kind::capacitance_at_outputs});
      options.node_capacitance.reset();
      CHECK(certify(one, *problem, options).dynamics->slowest == stiff.dynamics->slowest);
    }
  CHECK(certify(Realization::least_squares, *problem, {.opamp = opamp, .node_capacitance = farad})
            .stability == Stability::unstable);
}

TEST_CASE("what a board adds is in the poles, and each theorem says what it does not cover",
          "[certificate][stability]") {
  const NetworkProblem problem = array_network(9, 1e-3).problem;
  using enum TheoremCondition;
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    RealizationOptions options{.opamp = one_pole};
    if (!traits(one).drives_nodes) options.node_capacitance = 1e-11;
    const Certificate bare = certify(one, problem, options);
    REQUIRE(bare.theorem.holds());

    options.resistor_capacitance = 1e-13;
    const NetworkCircuit board(one, std::make_shared<const NetworkProblem>(problem), options);
    const Certificate c = certify(board);
    CHECK(c.theorem.unmet.value().condition == no_resistor_capacitance);
    CHECK_FALSE(c.tolerance_margin);
    CHECK(c.dynamics.value().slowest != bare.dynamics.value().slowest);
    CHECK(c.elements.capacitors == bare.elements.capacitors + board.circuit().resistors.size());
    CHECK(count_states(board.flat()) == c.dynamics->states);
    options.resistor_capacitance.reset();

    // Between the inputs as from each of them: half of it where the other input is at ground, or is
    // the first one's opposite.
    options.opamp.differential_capacitance = 1e-12;
    const Certificate between = certify(one, problem, options);
    options.opamp.differential_capacitance.reset();
    const bool floats = one == Realization::lattice;
    options.opamp.input_capacitance = floats ? 2e-12 : 1e-12;
    const Certificate to_ground = certify(one, problem, options);
    if (one == Realization::nic || one == Realization::rail) {
      CHECK(between.theorem.unmet.value().condition ==
            (one == Realization::nic ? divider_fast_enough : no_input_capacitance));
      continue;
    }
    CHECK(between.theorem.holds() == to_ground.theorem.holds());
    CHECK_FALSE(between.tolerance_margin);
    CHECK_THAT(between.dynamics.value().slowest,
               WithinRel(to_ground.dynamics.value().slowest, floats ? 1e-5 : 1e-9));
    if (one == Realization::least_squares)
      CHECK(between.theorem.unmet.value().lag.number == to_ground.theorem.unmet->lag.number);
  }
}

TEST_CASE("without a bandwidth theorems speak, and what is lossless never settles",
          "[certificate]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const Certificate c = certify(Realization::crossbar, network.problem, {});
  CHECK_FALSE(c.dynamics);
  CHECK(c.stability == Stability::stable);
  CHECK(certify(Realization::lc, network.problem, {}).stability == Stability::lossless);
  CHECK(certify(Realization::ndr, network.problem, {}).stability == Stability::stable);
  CHECK_THROWS_AS(certify(Realization::nic, network.problem, {}, 1.0), std::invalid_argument);
}
