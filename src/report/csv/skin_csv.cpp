#include "tactile_net/report/csv/skin_csv.hpp"

#include <cmath>
#include <optional>

#include "report/columns.hpp"
#include "report/csv/frame_row.hpp"
#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::report {

std::vector<std::string> traction_columns(const SurfaceGrid& grid, std::size_t components) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column)
        names.push_back(std::string(name(skin_tractions[c])) + '_' + std::to_string(row) + '_' +
                        std::to_string(column));
  return names;
}

namespace {

/// Whether frames may have them: one that is answered by an alpha all the same has none.
bool has_intervals(const lab::SkinSceneProblem& problem) { return problem.answers_by_mixture(); }

bool is_curved(const SkinScene& scene) { return scene.sensor.curved != nullptr; }

}  // namespace

std::vector<std::string> resultant_columns(bool intervals, bool curved) {
  return columns_of<ResultantRow>(true, intervals, curved);
}

std::vector<double> resultant_values(const lab::FrameAnswer& answer, bool intervals, bool curved) {
  ResultantRow row{answer.wrench};
  if (const auto& friction = answer.friction) {
    const double ratio = friction->ratio.value;
    row.friction = friction->ratio;
    row.angle = Uncertain{std::atan(ratio), friction->ratio.deviation / (1.0 + ratio * ratio)};
    row.slip_margin = friction->slip_margin;
  }
  return values_of(row, true, intervals, curved);
}

std::vector<std::string> uncertainty_columns(const lab::SkinSceneProblem& problem) {
  const SkinScene& scene = problem.scene();
  std::vector<std::string> names = resultant_columns(has_intervals(problem), is_curved(scene));
  if (scene.reconstruct.offset)
    for (const Channel& channel : channels(scene.sensor)) names.push_back("offset_" + channel.name);
  for (std::string& name : columns_of<TrustRow>(true)) names.push_back(std::move(name));
  names.emplace_back("verdict");
  return names;
}

std::vector<double> uncertainty_values(const lab::SkinSceneProblem& problem,
                                       const lab::FrameAnswer& answer) {
  const SkinScene& scene = problem.scene();
  std::vector<double> values = resultant_values(answer, has_intervals(problem), is_curved(scene));
  if (scene.reconstruct.offset)
    values.insert(values.end(), answer.offsets.begin(), answer.offsets.end());
  for (const double value : values_of(trust_row(answer.data, answer.alpha.value), true))
    values.push_back(value);
  return values;
}

}  // namespace tactile_net::report
