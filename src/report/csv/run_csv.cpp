#include "tactile_net/report/csv/run_csv.hpp"

#include <span>
#include <string>
#include <vector>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/report/words/deck_words.hpp"

namespace tactile_net::report {
namespace {

/// One frame under its header.
std::string csv(std::span<const std::string> columns, std::span<const double> values) {
  std::string text;
  frames::append_header(text, columns, false);
  frames::append_row(text, values);
  return text;
}

/// Of a line: one frame, as `solve` writes it.
std::string tractions_csv(std::span<const double> tractions, std::size_t places) {
  return csv(frames::traction_columns(places, tractions.size() > places), tractions);
}

/// Of a skin: a row for each cell.
std::string cells_csv(const lab::Experiment& experiment) {
  const SurfaceGrid& grid = experiment.grid;
  std::vector<std::string> names = {"y", "z"};
  std::vector<std::span<const double>> columns;
  const auto add = [&](const std::vector<double>& values, const std::string& suffix) {
    for (const Traction which : skin_tractions) {
      const auto column = lab::component(values, grid, which);
      if (column.empty()) continue;
      names.push_back(std::string(name(which)) + suffix);
      columns.push_back(column);
    }
  };
  if (!experiment.results.empty()) {
    add(experiment.results.front().answer.tractions, "");
    add(experiment.results.front().answer.deviations, "_deviation");
  }
  if (experiment.has_truth()) add(experiment.frame.truth, "_true");
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

drawing::Files run_files(const lab::Experiment& experiment) {
  drawing::Files files;
  if (experiment.of_skin()) {
    const SkinScene& scene = experiment.skin();
    files.emplace_back("readings.csv", csv(reading_names(scene.sensor),
                                           raw_numbers(scene, experiment.frame.readings)));
    files.emplace_back("tractions.csv", cells_csv(experiment));
  } else {
    const Scene& scene = experiment.line();
    const std::size_t places = experiment.places();
    files.emplace_back("readings.csv", csv(frames::reading_columns(scene.sensor),
                                           raw_numbers(scene, experiment.frame.readings)));
    files.emplace_back("truth.csv", tractions_csv(experiment.frame.truth, places));
    for (const lab::MethodResult& result : experiment.results)
      if (result.has_answer())
        files.emplace_back("tractions-" + std::string(name(result.method)) + ".csv",
                           tractions_csv(result.answer.tractions, places));
  }
  if (experiment.circuit)
    files.emplace_back("network.cir", deck_text(*experiment.circuit, tactile_net::Answer::printed));
  return files;
}

}  // namespace tactile_net::report
