#include "tactile_net/report/csv/skin_csv.hpp"

#include <span>
#include <vector>

#include "tactile_net/frames/csv.hpp"

namespace tactile_net::report {
namespace {

std::string readings_csv(const lab::SkinExperiment& experiment) {
  std::string text;
  frames::append_header(text, reading_names(experiment.scene.sensor), false);
  frames::append_row(text, raw_numbers(experiment.scene, experiment.frame.readings));
  return text;
}

std::string tractions_csv(const lab::SkinExperiment& experiment) {
  const SkinGrid& grid = experiment.grid;
  std::vector<std::string> names = {"y", "z"};
  std::vector<std::span<const double>> columns;
  const auto add = [&](const std::vector<double>& values, const std::string& suffix) {
    for (const SkinTraction which : skin_tractions) {
      const auto column = lab::component(values, grid, which);
      if (column.empty()) continue;
      names.push_back(std::string(name(which)) + suffix);
      columns.push_back(column);
    }
  };
  if (experiment.answer) {
    add(experiment.answer->tractions, "");
    add(experiment.answer->deviations, "_deviation");
  }
  add(experiment.frame.truth, "_true");
  std::string text;
  frames::append_header(text, names, false);
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      std::vector<double> values = {grid.y(row), grid.z(column)};
      for (const auto& all : columns) values.push_back(all[row * grid.columns + column]);
      frames::append_row(text, values);
    }
  return text;
}

}  // namespace

drawing::Files run_files(const lab::SkinExperiment& experiment) {
  return {{"readings.csv", readings_csv(experiment)}, {"tractions.csv", tractions_csv(experiment)}};
}

}  // namespace tactile_net::report
