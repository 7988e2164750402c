#include "tactile_net/report/csv/skin_csv.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/report/words/deck_words.hpp"

namespace tactile_net::report {
namespace {

constexpr std::ptrdiff_t after_wrench = 2;  // `data` and `alpha`

std::string readings_csv(const lab::SkinExperiment& experiment) {
  std::string text;
  frames::append_header(text, reading_names(experiment.scene.sensor), false);
  frames::append_row(text, raw_numbers(experiment.scene, experiment.frame.readings));
  return text;
}

std::string tractions_csv(const lab::SkinExperiment& experiment) {
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
  if (experiment.answer) {
    add(experiment.answer->tractions, "");
    add(experiment.answer->deviations, "_deviation");
  }
  if (!experiment.frame.truth.empty()) add(experiment.frame.truth, "_true");
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
  drawing::Files files = {{"readings.csv", readings_csv(experiment)},
                          {"tractions.csv", tractions_csv(experiment)}};
  if (experiment.network && experiment.network->circuit)
    files.emplace_back("network.cir",
                       deck_text(*experiment.network->circuit, tactile_net::Answer::printed));
  return files;
}

std::vector<std::string> traction_columns(const SurfaceGrid& grid, std::size_t components) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column)
        names.push_back(std::string(name(skin_tractions[c])) + '_' + std::to_string(row) + '_' +
                        std::to_string(column));
  return names;
}

std::vector<std::string> wrench_columns() {
  std::vector<std::string> names;
  for (const char* what :
       {"normal", "tangential_y", "tangential_z", "centre_y", "centre_z", "torsion", "friction"}) {
    names.emplace_back(what);
    names.push_back(std::string(what) + "_deviation");
  }
  names.emplace_back("data");
  names.emplace_back("alpha");
  return names;
}

std::vector<double> wrench_values(const lab::FrameAnswer& answer) {
  std::vector<double> values;
  const auto add = [&](const std::optional<Uncertain>& one) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    values.push_back(one ? one->value : none);
    values.push_back(one ? one->deviation : none);
  };
  const UncertainWrench& wrench = answer.wrench;
  add(wrench.normal);
  for (const auto* one : {&wrench.tangential_y, &wrench.tangential_z, &wrench.centre_y,
                          &wrench.centre_z, &wrench.torsion})
    add(*one);
  add(answer.friction ? std::optional(answer.friction->ratio) : std::nullopt);
  values.push_back(
      answer.data->consistent() ? 0.0 : 1.0 + static_cast<double>(answer.data->doubts.front()));
  values.push_back(answer.alpha.value);
  return values;
}

std::vector<std::string> uncertainty_columns(const SkinScene& scene) {
  std::vector<std::string> names = wrench_columns();
  std::vector<std::string> more = {"angle", "angle_deviation", "slip_margin",
                                   "slip_margin_deviation"};
  if (scene.reconstruct.offset)
    for (const Channel& channel : channels(scene.sensor)) more.push_back("offset_" + channel.name);
  names.insert(names.end() - after_wrench, more.begin(), more.end());
  names.emplace_back("verdict");
  return names;
}

std::vector<double> uncertainty_values(const lab::FrameAnswer& answer, const SkinScene& scene) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> more(4, none);
  if (const auto& friction = answer.friction) {
    const double ratio = friction->ratio.value;
    more[0] = std::atan(ratio);
    more[1] = friction->ratio.deviation / (1.0 + ratio * ratio);
    if (friction->slip_margin) {
      more[2] = friction->slip_margin->value;
      more[3] = friction->slip_margin->deviation;
    }
  }
  if (scene.reconstruct.offset)
    more.insert(more.end(), answer.offsets.begin(), answer.offsets.end());
  std::vector<double> values = wrench_values(answer);
  values.insert(values.end() - after_wrench, more.begin(), more.end());
  return values;
}

}  // namespace tactile_net::report
