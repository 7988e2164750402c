#include "network/output_current.hpp"

#include <cmath>

#include "network/nodal_equations.hpp"

namespace tactile_net {

OutputCurrent output_current(const FlatCircuit& circuit) {
  const Circuit& flat = circuit.circuit();
  const Eigen::VectorXd volts = NodalEquations(circuit).voltages();
  // Current that leaves each node through resistors and devices: an output's own law.
  std::vector<double> ampere(flat.nodes.size());
  const auto conduct = [&](Node from, Node to, double siemens) {
    const double current =
        siemens * (volts(static_cast<Eigen::Index>(from)) - volts(static_cast<Eigen::Index>(to)));
    ampere[from] += current;
    ampere[to] -= current;
  };
  for (const Resistor& r : flat.resistors) conduct(r.from, r.to, r.siemens);
  for (const NShapedDevice& b : flat.devices) conduct(b.from, b.to, -b.siemens);

  OutputCurrent result;
  for (std::size_t k = 0; k < flat.instances.size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
    for (const Node output : {x.out, x.inverse}) {
      if (output == 0 || std::abs(ampere[output]) <= result.largest) continue;
      result = {std::abs(ampere[output]), flat.instances[k].name};
    }
  }
  return result;
}

}  // namespace tactile_net
