#include "skin/large/uniform_readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tactile_net {
namespace {

std::vector<double> readings_of(LargeSkinSystem& system, std::size_t component) {
  std::vector<double> uniform(system.tractions());
  const std::size_t cells = system.problem.grid.count();
  std::fill_n(uniform.begin() + static_cast<std::ptrdiff_t>(component * cells), cells, 1.0);
  return weighted_product(system, uniform);
}

double least_of_a_taxel(const LinearProblem& problem, const std::vector<double>& readings) {
  std::vector<double> of_taxel(problem.taxels);
  std::vector<bool> lives(problem.taxels);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::size_t taxel = problem.sites[i].taxel;
    of_taxel[taxel] = std::hypot(of_taxel[taxel], readings[i]);
    if (problem.weights[i] > 0.0) lives[taxel] = true;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t taxel = 0; taxel < lives.size(); ++taxel)
    if (lives[taxel]) least = std::min(least, of_taxel[taxel]);
  return least;
}

}  // namespace

UniformReadings uniform_readings(LargeSkinSystem& system) {
  UniformReadings uniform{.drag = std::numeric_limits<double>::infinity()};
  for (const double reading : readings_of(system, 0))
    uniform.pressure = std::max(uniform.pressure, std::abs(reading));
  for (std::size_t u = 1; u < system.problem.components; ++u)
    uniform.drag = std::min(uniform.drag, least_of_a_taxel(system.problem, readings_of(system, u)));
  return uniform;
}

}  // namespace tactile_net
