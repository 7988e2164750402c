#include "tactile_net/lab/skin_network.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace tactile_net::lab {
namespace {

std::vector<std::string> node_names(const LinearProblem& problem) {
  constexpr std::array<std::string_view, 3> letters = {"p_", "qy_", "qz_"};
  std::vector<std::string> names;
  for (std::size_t component = 0; component < problem.components; ++component)
    for (std::size_t row = 0; row < problem.grid.rows; ++row)
      for (std::size_t column = 0; column < problem.grid.columns; ++column)
        names.push_back(std::string(letters[component]) + std::to_string(row) + "_" +
                        std::to_string(column));
  return names;
}

}  // namespace

NetworkProblem skin_network_problem(const LinearProblem& problem, double alpha,
                                    std::span<const double> readings) {
  NetworkProblem result = network_problem(problem, alpha, readings);
  result.names = node_names(problem);
  return result;
}

std::optional<std::string> too_large(Realization realization, std::size_t tractions,
                                     std::size_t readings) {
  const std::string counted = "a skin of " + std::to_string(tractions) + " tractions makes ";
  constexpr std::string_view coarser =
      "; a coarser spacing under [network], or a smaller margin under [reconstruct], has fewer";
  if (traits(realization).takes_readings) {
    const std::size_t amplifiers = tractions + readings;
    if (amplifiers <= most_amplifiers) return std::nullopt;
    return counted + std::to_string(amplifiers) + " amplifiers, more than " +
           std::to_string(most_amplifiers) + std::string(coarser);
  }
  const std::size_t branches = tractions * (tractions - 1) / 2;
  if (branches <= most_branches) return std::nullopt;
  return counted + std::to_string(branches) + " branches of P, more than " +
         std::to_string(most_branches) + ": the realization least_squares takes two arrays of " +
         std::to_string(readings) + " x " + std::to_string(tractions) + " and no P" +
         std::string(coarser);
}

}  // namespace tactile_net::lab
