#include "tactile_net/lab/data_verdict.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net::lab {

DataLimits data_limits(const SceneProblem& problem) {
  const Scene& scene = problem.scene();
  const double modulus = scene.material.youngs_modulus;
  DataLimits limits{.noise_rms = problem.stated_noise(),
                    .friction_limit = scene.reconstruct.friction_limit,
                    .largest_traction = modulus};
  for (const Channel& channel : channels(scene.sensor))
    limits.largest_readings.insert(limits.largest_readings.end(), scene.sensor.count,
                                   is_strain(channel.quantity) ? 1.0 : modulus);

  const std::vector<double> taxels = positions(scene.sensor);
  const auto [first, last] = std::minmax_element(taxels.begin(), taxels.end());
  const double middle = 0.5 * (*first + *last);
  const double quarter = 0.25 * (*last - *first);
  limits.inner = {middle - quarter, middle + quarter};
  return limits;
}

DataJudge data_judge(const SceneProblem& problem) {
  // Contacts may be narrower than the tractions' grid, and hang over the array's ends.
  constexpr std::size_t most_values = 512;
  const Scene& scene = problem.scene();
  ProblemOptions options = problem.options();
  const double depth = *std::min_element(scene.sensor.depths.begin(), scene.sensor.depths.end());
  options.surface = {.basis = SurfaceBasis::hats,
                     .spacing = std::min(0.25 * depth, problem.surface().spacing)};
  if (surface_of(scene.sensor, options.surface).count > most_values)
    return DataJudge(problem.problem(), data_limits(problem));
  return DataJudge(problem.problem(), make_problem(scene.sensor, scene.material, options),
                   data_limits(problem));
}

std::optional<DataVerdict> data_verdict(const SceneProblem& problem,
                                        std::span<const double> readings,
                                        std::span<const double> tractions) {
  if (problem.is_large()) return std::nullopt;
  return problem.data_judge().judge(readings, tractions);
}

void doubt(DataVerdict& data, std::optional<std::size_t> bad_taxel) {
  if (!bad_taxel) return;
  data.taxel = bad_taxel;
  if (data.has(DataDoubt::bad_taxel)) return;
  data.doubts.push_back(DataDoubt::bad_taxel);
  std::sort(data.doubts.begin(), data.doubts.end());
}

}  // namespace tactile_net::lab
