#include <algorithm>
#include <cmath>

#include "network/nodes.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

Circuit least_squares(const NetworkProblem& problem, const RealizationOptions& options) {
  check(options);
  const Matrix& k = problem.kernel;
  const double scale = as_eigen(k).colwise().norm().maxCoeff();
  if (!(scale > 0.0)) throw std::invalid_argument("K must not be zero");
  const double siemens = options.scale.siemens * scale * scale;  // per unit of K / scale
  const double rho = options.residual_gain;

  Circuit circuit;
  circuit.divider = options.divider;
  const std::string main = add_models(circuit, Realization::least_squares, options);
  const std::string others = circuit.amplifiers.front().name;
  std::vector<Signed> f;
  std::vector<Signed> e;
  for (std::size_t j = 0; j < k.columns; ++j) {
    const std::string index = std::to_string(j);
    f.push_back(
        add_amplifier(circuit, "s" + index, "n" + index, "r" + index, main, options.inverters));
    circuit.outputs.push_back(f[j].plus);
  }
  for (std::size_t i = 0; i < k.rows; ++i) {
    const auto row = k.row(i);
    if (std::all_of(row.begin(), row.end(), [](double value) { return value == 0.0; })) {
      e.push_back({});  // a dead taxel has no residual
      continue;
    }
    const std::string index = std::to_string(i);
    e.push_back(
        add_amplifier(circuit, "t" + index, "e" + index, "q" + index, others, options.inverters));
  }

  for (std::size_t i = 0; i < k.rows; ++i) {
    if (e[i].summing == 0) continue;
    const std::string row = std::to_string(i);
    for (std::size_t j = 0; j < k.columns; ++j) {
      const std::string pair = row + "_" + std::to_string(j);
      const double conductance = siemens * (k(i, j) / scale);
      add_signed(circuit, "Rk" + pair, f[j], e[i].summing, conductance);
      add_signed(circuit, "Rt" + pair, e[i], f[j].summing, -conductance);
    }
    circuit.resistors.push_back({"Re" + row, e[i].plus, e[i].summing, siemens / rho});
    circuit.sources.push_back(
        {"I" + row, e[i].summing,
         0.0 - siemens * options.scale.volts * (problem.readings[i] / scale)});
  }
  for (std::size_t i = 0; i < k.columns; ++i)
    for (std::size_t j = 0; j < k.columns; ++j)
      add_signed(circuit, "Rs" + std::to_string(i) + "_" + std::to_string(j), f[j], f[i].summing,
                 rho * options.scale.siemens * problem.stabiliser(i, j));
  return circuit;
}

}  // namespace tactile_net
