// The inverse problem as a circuit: conductances, realised by op-amps, written as a SPICE deck.
// Prints the deck, whose node voltages are the tractions: `05_deck > x.cir; ngspice -b x.cir`.
#include <iostream>
#include <tactile_net/circuit.hpp>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

int main() {
  const SensorArray array{
      .count = 5, .pitch = 1e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const LinearProblem problem = make_problem(array, silicone, {.smoothing_length = 1.5e-3});
  const std::vector<double> readings = {20.0, 120.0, 300.0, 120.0, 20.0};  // [Pa]
  const double alpha = 1e-2;

  // P f = b as currents into a network of conductances P; a node's voltage is its traction.
  const NetworkProblem network = network_problem(problem, alpha, readings);
  const RealizationOptions options{.scale = {.siemens = 1e-3, .volts = 1e-3}};  // 1 kPa is 1 V
  const Circuit circuit = realize(Realization::nic, network, options);

  DeckHeader header{.title = "Five taxels, negative conductances by converters"};
  header.comments = {"node n<i>: the traction at taxel i, 1 mV for each Pa"};
  for (const double f : tikhonov_solve(problem, alpha, readings))
    header.expected.push_back(options.scale.volts * f);  // what the simulator should find
  write_deck(std::cout, circuit, header, Answer::printed);

  const ElementCounts elements = count_elements(circuit);
  std::cout << "* in all: " << elements.resistors << " resistors, " << elements.opamps
            << " op-amps, none of them negative\n";
  return std::cout && elements.opamps > 0 && elements.negative_resistors == 0 ? 0 : 1;
}
