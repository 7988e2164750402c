#include "network/nodes.hpp"

namespace tactile_net {

Circuit crossbar(const Matrix& matrix, std::span<const double> right_side,
                 const RealizationOptions& options) {
  const std::size_t n = matrix.rows;
  if (n == 0 || matrix.columns != n || matrix.values.size() != n * n || right_side.size() != n)
    throw std::invalid_argument("a crossbar needs a square matrix and one current per row");
  if (!all_finite(matrix.values) || !all_finite(right_side))
    throw std::invalid_argument("the matrix and the currents must be finite");
  check(options);

  Circuit circuit;
  circuit.divider = options.divider;
  const std::string main = add_models(circuit, Realization::crossbar, options);
  std::vector<Signed> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string index = std::to_string(i);
    nodes.push_back(
        add_amplifier(circuit, "s" + index, "n" + index, "r" + index, main, options.inverters));
    circuit.outputs.push_back(nodes[i].plus);
  }
  const double siemens = options.scale.siemens;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string row = std::to_string(i);
    for (std::size_t j = 0; j < n; ++j)
      add_signed(circuit, "R" + row + "_" + std::to_string(j), nodes[j], nodes[i].summing,
                 siemens * matrix(i, j));
    circuit.sources.push_back(
        {"I" + row, nodes[i].summing, 0.0 - siemens * options.scale.volts * right_side[i]});
  }
  return circuit;
}

}  // namespace tactile_net
