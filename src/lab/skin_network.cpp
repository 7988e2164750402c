#include "tactile_net/lab/skin_network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "network/rounding.hpp"
#include "tactile_net/skin/stabiliser.hpp"

namespace tactile_net::lab {

NetworkProblem network_problem(const SkinProblem& problem, double alpha,
                               std::span<const double> readings) {
  NetworkProblem result{.matrix = normal_matrix(problem, alpha),
                        .right_side = normal_right_side(problem, readings),
                        .kernel = problem.kernel,
                        .stabiliser = stabiliser_matrix(problem, alpha),
                        .readings = weighted(problem, readings)};
  drop_rounding(result.matrix, 0.0);
  const auto entries = static_cast<double>(problem.kernel.values.size());
  drop_rounding(result.kernel, problem.kernel_error / std::sqrt(entries));
  return result;
}

void check_size(Realization realization, const SkinProblem& problem) {
  const std::size_t nodes = problem.kernel.columns;
  const std::string counted = "a skin of " + std::to_string(nodes) + " tractions makes ";
  constexpr std::string_view coarser = "; a coarser reconstruct.spacing has fewer";
  if (traits(realization).takes_readings) {
    const std::size_t amplifiers = nodes + problem.kernel.rows;
    if (amplifiers > most_amplifiers)
      throw std::invalid_argument(counted + std::to_string(amplifiers) + " amplifiers, more than " +
                                  std::to_string(most_amplifiers) + std::string(coarser));
    return;
  }
  const std::size_t branches = nodes * (nodes - 1) / 2;
  if (branches > most_branches)
    throw std::invalid_argument(counted + std::to_string(branches) + " branches of P, more than " +
                                std::to_string(most_branches) +
                                ": the realization least_squares takes two arrays of " +
                                std::to_string(problem.kernel.rows) + " x " +
                                std::to_string(nodes) + " and no P" + std::string(coarser));
}

Circuit named_by_cells(Circuit circuit, const SkinGrid& grid) {
  constexpr std::array<std::string_view, 3> components = {"p_", "qy_", "qz_"};
  const std::size_t cells = grid.count();
  if (circuit.outputs.size() != cells && circuit.outputs.size() != 3 * cells)
    throw std::invalid_argument("the circuit needs an output for each cell, or three");
  for (std::size_t i = 0; i < circuit.outputs.size(); ++i) {
    std::string name(components[i / cells]);
    name += std::to_string(i % cells / grid.columns);
    name += '_';
    name += std::to_string(i % cells % grid.columns);
    circuit.nodes[circuit.outputs[i]] = std::move(name);
  }
  return circuit;
}

}  // namespace tactile_net::lab
