#include "lab/skin_constraint_bias.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace tactile_net::lab {
namespace {

/// The same in every frame: equal input, equal bytes.
std::vector<double> fixed_noise(std::size_t readings, double rms) {
  std::mt19937_64 random(1);
  std::vector<double> noise(readings);
  constexpr int uniforms = 12;  // of variance 1/12 each: their sum is the same on every system
  for (double& one : noise) {
    double sum = -0.5 * uniforms;
    for (int i = 0; i < uniforms; ++i) sum += std::ldexp(static_cast<double>(random()), -64);
    one = rms * sum;
  }
  return noise;
}

double pressed(std::span<const double> tractions, std::span<const std::size_t> cells) {
  return std::accumulate(cells.begin(), cells.end(), 0.0,
                         [&](double sum, std::size_t cell) { return sum + tractions[cell]; });
}

/// Of a contact alone, what every taxel would read, weighted.
std::vector<double> weighted_readings(const LinearProblem& problem,
                                      std::span<const double> tractions,
                                      std::span<const std::size_t> cells) {
  std::vector<double> readings(problem.kernel.rows);
  const std::size_t count = problem.grid.count();
  for (std::size_t row = 0; row < readings.size(); ++row)
    for (std::size_t u = 0; u < problem.components; ++u)
      for (const std::size_t cell : cells)
        readings[row] += problem.kernel(row, u * count + cell) * tractions[u * count + cell];
  return readings;
}

}  // namespace

double constraint_bias(const ContactAlone& contact,
                       const std::function<ConeSolution(std::span<const double>)>& solve,
                       double noise_rms) {
  const double put_in = pressed(contact.tractions, contact.cells);
  if (!(put_in > 0.0)) return 0.0;
  const std::vector<double> noise = fixed_noise(contact.read.size(), noise_rms);
  double found = 0.0;
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> readings(contact.read.size());
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (contact.weights[i] > 0.0)
        readings[i] = (contact.read[i] + sign * noise[i]) / contact.weights[i];
    const ConeSolution again = solve(readings);
    if (again.status != FrameStatus::ok) return 0.0;
    found += 0.5 * pressed(again.tractions, contact.cells);
  }
  return std::clamp((found - put_in) / put_in, -0.5, 0.5);
}

double constraint_bias(const SkinSceneProblem& problem, const SkinMethod& method,
                       std::span<const double> tractions, std::span<const std::size_t> cells,
                       double alpha, double noise_rms) {
  return constraint_bias(
      {.tractions = {tractions.begin(), tractions.end()},
       .cells = cells,
       .weights = problem.problem().weights,
       .read = weighted_readings(problem.problem(), tractions, cells)},
      [&](std::span<const double> readings) { return method.solve_in_cones(readings, alpha); },
      noise_rms);
}

}  // namespace tactile_net::lab
