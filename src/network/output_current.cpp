#include "network/output_current.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "network/nodal_equations.hpp"
#include "tactile_net/network/operating_voltages.hpp"

namespace tactile_net {

namespace {

/// Current that leaves each node through resistors and devices: an output's own law.
std::vector<double> leaving(const FlatCircuit& circuit) {
  const Circuit& flat = circuit.circuit();
  const Eigen::VectorXd volts = NodalEquations(circuit).voltages();
  std::vector<double> ampere(flat.nodes.size());
  const auto conduct = [&](Node from, Node to, double siemens) {
    const double current =
        siemens * (volts(static_cast<Eigen::Index>(from)) - volts(static_cast<Eigen::Index>(to)));
    ampere[from] += current;
    ampere[to] -= current;
  };
  for (const Resistor& r : flat.resistors) conduct(r.from, r.to, r.siemens);
  for (const NShapedDevice& b : flat.devices) conduct(b.from, b.to, -b.siemens);
  return ampere;
}

}  // namespace

double sourced_current(const FlatCircuit& circuit) {
  const std::vector<double> ampere = leaving(circuit);
  double sum = 0.0;
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers())
    for (const Node output : {x.out, x.inverse})
      if (output != 0) sum += std::max(ampere[output], 0.0);
  return sum;
}

OutputCurrent output_current(const FlatCircuit& circuit) {
  const std::vector<double> ampere = leaving(circuit);
  OutputCurrent result;
  for (std::size_t k = 0; k < circuit.amplifiers().size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
    for (const Node output : {x.out, x.inverse}) {
      if (output == 0 || std::abs(ampere[output]) <= result.largest) continue;
      result = {std::abs(ampere[output]), circuit.circuit().instances[k].name};
    }
  }
  return result;
}

}  // namespace tactile_net
