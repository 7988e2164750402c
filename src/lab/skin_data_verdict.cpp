#include "lab/skin_data_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "lab/lines_and_skins.hpp"

namespace tactile_net::lab {
namespace {

/// Whether a curved surface goes on as far as these cells do.
bool reaches(const SkinScene& scene, const SurfaceGrid& cells) {
  if (!scene.sensor.curved) return true;
  try {
    (void)scene.sensor.curved->surface.cells(cells);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

DataLimits data_limits(const SkinSceneProblem& problem) { return limits_of(problem); }

std::vector<double> without_offsets(const SkinSceneProblem& problem,
                                    std::span<const double> readings,
                                    std::span<const double> tractions) {
  std::vector<double> rest(readings.begin(), readings.end());
  if (!problem.layout().unknown_offsets) return rest;
  const std::vector<double> found = offsets(problem.problem(), readings, tractions);
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[i] -= found[problem.problem().sites[i].channel];
  return rest;
}

double largest_force(const SkinSceneProblem& problem, std::span<const double> readings) {
  const LinearProblem& solved = problem.layout();
  const DataLimits limits = data_limits(problem);
  double strain = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (solved.weights[i] > 0.0)
      strain = std::max(strain, std::abs(readings[i]) / limits.largest_readings[i]);
  return strain * problem.scene().material.youngs_modulus * solved.grid.area() *
         static_cast<double>(solved.grid.count());
}

DataJudge data_judge(const SkinSceneProblem& problem) {
  constexpr std::size_t most_cells_sought = 2400;
  const SkinScene& scene = problem.scene();
  const SurfaceGrid& own = problem.grid();
  const double depth = least_depth(scene.sensor);
  const double spacing = std::min({0.25 * depth, own.spacing_y, own.spacing_z});
  for (const SkinGridOptions& finer :
       {SkinGridOptions{.spacing = spacing, .margin = 2.0 * depth},
        SkinGridOptions{.spacing = std::min(own.spacing_y, own.spacing_z),
        .margin = 2.0 * depth}}) {
    if (!problem.stated_noise()) break;
    const SurfaceGrid cells = grid_of(scene.sensor, finer);
    if (cells.count() <= most_cells_sought && reaches(scene, cells))
      return DataJudge(
          problem.shared_problem(), [scene, finer] { return SkinSceneProblem(scene).on(finer); },
          data_limits(problem));
  }
  return DataJudge(problem.shared_problem(), {}, data_limits(problem));
}

}  // namespace tactile_net::lab
