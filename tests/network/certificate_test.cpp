#include "tactile_net/network/certificate.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

const OpAmp one_pole{.gain = 1e6, .bandwidth = 1e7};

NetworkProblem indefinite() {
  NetworkProblem problem = array_network(11, 1e-3).problem;
  const double shift = smallest_eigenvalue(problem.matrix) + 1e-4;
  for (std::size_t i = 0; i < 11; ++i) problem.matrix(i, i) -= shift;
  return problem;
}

}  // namespace

TEST_CASE("a definite P is certified by the theorem of its realisation", "[certificate]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  for (const Realization one :
       {Realization::nic, Realization::rail, Realization::crossbar, Realization::least_squares}) {
    CAPTURE(name(one));
    const Certificate c = certify(one, network.problem, {.opamp = one_pole});
    CHECK(c.stability == Stability::stable);
    CHECK(c.theorem.holds);
    CHECK(c.theorem.condition.empty());
    REQUIRE(c.dynamics);
    CHECK(c.dynamics->slowest < 0.0);
    CHECK(c.dynamics->poles.size() == c.dynamics->states);
    CHECK(c.dynamics->poles.front().real() == c.dynamics->slowest);
    CHECK(c.dynamics->settling_seconds.value() > 0.0);
    CHECK(c.tolerance_margin.value() > 0.0);
    CHECK(c.warnings.empty());
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
    CHECK_FALSE(c.theorem.holds);
    CHECK(c.theorem.condition == "P is not positive definite");
    CHECK_FALSE(c.tolerance_margin);
    CHECK(std::isinf(c.condition));
    REQUIRE(c.dynamics);
    CHECK(c.dynamics->slowest > 0.0);
    CHECK_FALSE(c.dynamics->settling_seconds);
    CHECK(c.dynamics->mode.size() == 11);
  }
}

TEST_CASE("rules that are broken are said, with what to do", "[certificate]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const auto warning = [&](Realization one, const RealizationOptions& options) {
    const Certificate c = certify(one, network.problem, options);
    std::string text;
    for (const std::string& line : c.warnings) text += line + '\n';
    return text;
  };
  OpAmp with_rail = one_pole;
  with_rail.rail = 2.0;
  CHECK_THAT(warning(Realization::crossbar, {.scale = {.volts = 10.0}, .opamp = with_rail}),
             ContainsSubstring("op-amps clamp from 1.4 V") && ContainsSubstring("volts = "));
  OpAmp with_input = one_pole;
  with_input.input_capacitance = 1e-11;
  CHECK_THAT(warning(Realization::nic, {.opamp = with_input}),
             ContainsSubstring("divider = 788 at most"));
  CHECK(warning(Realization::nic, {.opamp = with_input, .divider = 700.0}).empty());
  CHECK_THAT(warning(Realization::least_squares, {.opamp = with_input}),
             ContainsSubstring("siemens = ") && ContainsSubstring("residual_gain"));
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
  REQUIRE(c.warnings.size() == 2);
  CHECK_THAT(c.warnings[0], ContainsSubstring("cannot be bought: siemens = "));
  CHECK_THAT(c.warnings[1], ContainsSubstring("would make it 1 V"));
}

TEST_CASE("what the certificate proposes against capacitance settles", "[certificate]") {
  const ArrayNetwork network = array_network(21, 1e-6);
  OpAmp opamp = one_pole;
  opamp.input_capacitance = 1e-12;
  RealizationOptions options{.opamp = opamp, .residual_gain = 100.0};
  const Certificate bad = certify(Realization::least_squares, network.problem, options);
  CHECK(bad.stability == Stability::unstable);
  CHECK_FALSE(bad.theorem.holds);
  REQUIRE(bad.warnings.size() == 1);
  const std::size_t at = bad.warnings[0].find("siemens = ") + 10;
  options.scale.siemens = std::stod(bad.warnings[0].substr(at));
  CHECK(certify(Realization::least_squares, network.problem, options).stability ==
        Stability::stable);
}

TEST_CASE("conditions of theorems are checked one by one", "[certificate]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const auto condition = [&](Realization one, const RealizationOptions& options) {
    return certify(one, network.problem, options).theorem.condition;
  };
  OpAmp two_poles = one_pole;
  two_poles.second_pole = 2e7;
  CHECK(condition(Realization::nic, {.opamp = two_poles}).empty());
  CHECK(condition(Realization::crossbar, {.opamp = two_poles}) == "a second pole");
  CHECK_THAT(condition(Realization::crossbar,
                       {.opamp = one_pole, .inverters = true, .bandwidth_ratio = 1.0}),
             ContainsSubstring("1 times the inverters' bandwidth"));
  CHECK_THAT(condition(Realization::least_squares,
                       {.opamp = one_pole, .inverters = true, .bandwidth_ratio = 1.0}),
             ContainsSubstring("not proven"));
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
