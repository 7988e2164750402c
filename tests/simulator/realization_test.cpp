// Analog against digital: every realisation of every kind of problem, relaxed by ngspice.
#include <cmath>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

namespace {

double difference(const Circuit& circuit, const ArrayNetwork& network,
                  const Analysis& analysis = DirectCurrent{}) {
  return relative_l2_error(at_rest(circuit, analysis), network.direct);
}

}  // namespace

TEST_CASE("every realisation solves P f = b, with one unknown and two, on a layer too",
          "[spice][realization]") {
  struct Kind {
    std::size_t count, unknowns;
    std::optional<Layer> layer;
  };
  const Kind kind = GENERATE(Kind{5, 1, {}}, Kind{21, 1, {}}, Kind{41, 1, {}}, Kind{21, 2, {}},
                             Kind{21, 2, Layer{3.0, Base::bonded}});
  const double alpha = GENERATE(1e-3, 1e-5);
  const ArrayNetwork network = array_network(kind.count, alpha, kind.unknowns, kind.layer);
  for (const Realization one :
       {Realization::ideal, Realization::nic, Realization::rail, Realization::crossbar,
        Realization::least_squares, Realization::lattice, Realization::lc})
    for (const RealizationOptions& options :
         {RealizationOptions{}, RealizationOptions{.inverters = true},
          RealizationOptions{.ladder = true}}) {
      if (options.inverters && !traits(one).drives_nodes) continue;
      if (options.ladder && !has_ladder(one, options)) continue;
      CAPTURE(kind.count, kind.unknowns, kind.layer.has_value(), alpha, name(one),
              options.inverters, options.ladder);
      const Analysis analysis = one == Realization::lc
                                    ? Analysis{SingleFrequency{options.frequency}}
                                    : Analysis{DirectCurrent{}};
      const double limit = one == Realization::ideal ? 1e-11 : 1e-10;
      CHECK(difference(realize(one, network.problem, options), network, analysis) <= limit);
    }
}

TEST_CASE("finite gain errs as one over the gain", "[spice][realization]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const auto at = [&](double gain) {
      return difference(realize(one, network.problem, {.opamp = {.gain = gain}}), network);
    };
    const double error = at(1e5);
    CHECK(error < 2e-4);
    CHECK(error > 1e-6);
    CHECK_THAT(at(1e4) / error, WithinRel(10.0, 0.05));
  }
}

TEST_CASE("N-shaped devices err as the square of node voltages over their own", "[spice][ndr]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  double cubic = 0.0;
  for (const Curve curve : {Curve::cubic, Curve::tunnel_diode}) {
    const auto at = [&](double volts) {
      return difference(
          realize(Realization::ndr, network.problem, {.curve = curve, .device_volts = volts}),
          network);
    };
    const double error = at(10.0);
    CHECK_THAT(error / at(20.0), WithinRel(4.0, 0.05));
    if (curve == Curve::cubic)
      cubic = error;
    else
      CHECK(error < 0.3 * cubic);  // no term of second order at the steepest point
  }
}

TEST_CASE("every step of the op-amp's model leaves the operating point where it belongs",
          "[spice][opamp]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    const auto with = [&](const OpAmp& opamp) {
      return difference(realize(one, network.problem, {.opamp = opamp}), network);
    };
    CAPTURE(name(one));
    const double gain = with({.gain = 1e6});
    CHECK_THAT(with({.gain = 1e6, .bandwidth = 1e7}), WithinRel(gain, 1e-3));
    CHECK_THAT(with({.gain = 1e6, .bandwidth = 1e7, .second_pole = 2e7}), WithinRel(gain, 1e-3));
    CHECK_THAT(with({.gain = 1e6, .bandwidth = 1e7, .input_capacitance = 1e-12}),
               WithinRel(gain, 1e-3));
    CHECK_THAT(with({.gain = 1e6, .rail = 12.0}), WithinRel(gain, 1e-2));
    CHECK(with({.gain = 1e6, .offset = 1e-4}) > 2.0 * gain);
    const std::vector<double> clamped = at_rest(realize(
        one, network.problem, {.scale = {.volts = 100.0}, .opamp = {.gain = 1e6, .rail = 2.0}}));
    CHECK(std::abs(clamped[2]) < 0.7 * 100.0 * network.direct[2]);  // it cannot reach the answer
  }
}

TEST_CASE("ngspice settles in a ladder's time, with second poles and capacitance at its nodes too",
          "[spice][ladder][long]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  struct Case {
    std::optional<double> second_pole{};
    std::optional<double> node{};
    double gain = 10.0;
  };
  for (const Case& one : {Case{}, Case{.second_pole = 2e7, .gain = 0.3}, Case{.node = 4e-13}}) {
    CAPTURE(one.second_pole.has_value(), one.node.has_value());
    const RealizationOptions options{
        .opamp = {.gain = 1e6, .bandwidth = 1e7, .second_pole = one.second_pole},
        .residual_gain = one.gain,
        .ladder = true,
        .node_capacitance = one.node};
    const Certificate certificate = certify(Realization::least_squares, network.problem, options);
    REQUIRE(certificate.stability == Stability::stable);
    const Circuit circuit = realize(Realization::least_squares, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    REQUIRE(seen.end == TransientEnd::settles);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.02));
  }
  // As op-amps are sold, with the gain that is the default: it grows, in both.
  const RealizationOptions sold{
      .opamp = {.gain = 1e6, .bandwidth = 1e7, .second_pole = 2e7, .rail = 12.0}, .ladder = true};
  const Certificate certificate = certify(Realization::least_squares, network.problem, sold);
  CHECK(certificate.stability == Stability::unstable);
  const Circuit circuit = realize(Realization::least_squares, network.problem, sold);
  Ngspice ngspice;
  CHECK(settle(ngspice, circuit, certificate, at_rest(circuit)).end != TransientEnd::settles);
}
