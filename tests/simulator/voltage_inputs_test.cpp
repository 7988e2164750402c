// Readings as voltages: ngspice against the equations.
#include <cmath>
#include <sstream>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

TEST_CASE("ngspice rests at the answer with voltages as inputs, drawn parts or exact ones",
          "[spice][voltage_inputs]") {
  const ArrayNetwork network = array_network(21, GENERATE(1e-3, 1e-5));
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice})
    for (const bool ladder : {false, true}) {
      RealizationOptions options{.inputs = Inputs::voltage};
      options.ladder = ladder;
      if (ladder && !has_ladder(one, options)) continue;
      CAPTURE(name(one), ladder);
      const FlatCircuit circuit(realize(one, network.problem, options));
      CHECK(relative_l2_error(at_rest(circuit.circuit()), network.direct) < 1e-9);
      const Reduction reduction(circuit);
      const ToleranceOptions draw{
          .relative = 0.01,
          .common = {.reel = 4e-3, .temperature = Temperature{40.0, 50e-6, 5e-6}}};
      const std::vector<double> siemens = drawn(reduction, draw, 3);
      const std::vector<double> v = at_rest(perturbed(circuit, siemens));
      const Trial trial = try_out(reduction, siemens);
      CHECK(trial.error > 1e-4);
      CHECK(relative_l2_error(v, trial.voltages) < 1e-9);
    }
}

TEST_CASE("ngspice settles in the certificate's time with voltages as inputs",
          "[spice][voltage_inputs]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    CAPTURE(name(one));
    const RealizationOptions options{.opamp = {.gain = 1e6,
                                               .bandwidth = 1e7,
                                               .second_pole = 5e7,
                                               .offset = 1e-3,
                                               .input_capacitance = 1e-12},
                                     .inputs = Inputs::voltage,
                                     .resistor_capacitance = 2e-13};
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    REQUIRE(seen.end == TransientEnd::settles);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.05));
  }
}
