#include "tactile_net/lab/data_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lab/line_answer.hpp"
#include "lab/lines_and_skins.hpp"

namespace tactile_net::lab {

DataLimits data_limits(const SceneProblem& problem) {
  DataLimits limits = limits_of(problem);
  const SensorArray& sensor = problem.scene().sensor;
  const double first = position(sensor, 0);
  const double last = position(sensor, sensor.count - 1);
  const double middle = 0.5 * (first + last);
  const double quarter = 0.25 * (last - first);
  limits.inner = {middle - quarter, middle + quarter};
  return limits;
}

DataJudge data_judge(const SceneProblem& problem) {
  constexpr std::size_t most_values = 512;
  const Scene& scene = problem.scene();
  const Surface& own = problem.surface();
  const double depth = least_depth(scene.sensor);
  LineProblemOptions options = problem.options();
  options.surface = {.basis = SurfaceBasis::hats, .spacing = std::min(0.25 * depth, own.spacing)};
  const Surface finer = surface_of(scene.sensor, options.surface);
  const bool is_own = own.basis == finer.basis && own.count == finer.count;
  if (is_own || finer.count > most_values || !problem.stated_noise())
    return DataJudge(problem.problem(), data_limits(problem));
  return DataJudge(problem.problem(), make_problem(scene.sensor, scene.material, options),
                   data_limits(problem));
}

std::optional<DataVerdict> data_verdict(const SceneProblem& problem,
                                        std::span<const double> readings,
                                        std::span<const double> tractions, DataMemory* memory) {
  return judged_data(LineFrameMethod({.problem = problem, .readings = readings, .memory = memory}),
                     tractions, 0.0);
}

remark::DataDoubted data_doubted(const DataVerdict& data, const Scene& scene) {
  return with_names(data, scene);
}

remark::DataDoubted data_doubted(const DataVerdict& data, const SkinScene& scene) {
  return with_names(data, scene);
}

void doubt(DataVerdict& data, std::optional<std::size_t> bad_taxel) {
  if (!bad_taxel) return;
  data.taxel = bad_taxel;
  if (data.has(DataDoubt::bad_taxel)) return;
  data.doubts.push_back(DataDoubt::bad_taxel);
  std::sort(data.doubts.begin(), data.doubts.end());
}

}  // namespace tactile_net::lab
