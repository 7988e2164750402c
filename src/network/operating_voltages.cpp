#include "tactile_net/network/operating_voltages.hpp"

#include "network/nodal_equations.hpp"

namespace tactile_net {

std::vector<double> operating_voltages(const FlatCircuit& circuit) {
  const Eigen::VectorXd v = NodalEquations(circuit).outputs();
  return {v.begin(), v.end()};
}

}  // namespace tactile_net
