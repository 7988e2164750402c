#include "tactile_net/report/csv/uncertainty_csv.hpp"

#include <limits>
#include <utility>
#include <variant>

#include "report/columns.hpp"
#include "report/csv/frame_row.hpp"
#include "tactile_net/frames/source.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"

namespace tactile_net::report {
namespace {

/// Whether frames may have them: one that is answered by an alpha all the same has none.
bool has_intervals(const lab::SceneProblem& problem) { return problem.answers_by_mixture(); }

std::vector<std::string> line_columns(const lab::SceneProblem& problem) {
  const bool intervals = has_intervals(problem);
  // The bare names of the tractions are these; the forces have names of their own.
  std::vector<std::string> columns =
      columns_of<ResultantRow>(false, intervals, false, [](std::string_view key, Measure measure) {
        return std::string(key) + (measure == Measure::load ? "_force" : "");
      });
  const auto add = [&](const char* what) {
    for (std::string& traction :
         frames::traction_columns(problem.surface().count, problem.options().unknowns > 1))
      columns.push_back(traction.insert(traction.find('_'), what));
  };
  add("_deviation");
  if (intervals) {
    add("_low");
    add("_high");
  }
  if (problem.options().unknown_offsets)
    for (const Channel& channel : channels(problem.scene().sensor))
      columns.push_back("offset_" + channel.name);
  for (std::string& name : columns_of<TrustRow>(false)) columns.push_back(std::move(name));
  columns.emplace_back("verdict");
  return columns;
}

std::vector<double> line_values(const lab::SceneProblem& problem, const lab::FrameAnswer& answer) {
  const bool intervals = has_intervals(problem);
  const lab::FrameUncertainty& uncertainty = *answer.bands;
  ResultantRow row{lab::resultant_told(answer)};
  row.angle = uncertainty.resultant.angle;
  row.residual = uncertainty.noise.residual_rms;
  row.model = uncertainty.noise.model_rms;
  std::vector<double> values = values_of(row, false, intervals);
  values.insert(values.end(), uncertainty.deviation.begin(), uncertainty.deviation.end());
  if (intervals)
    for (const auto* ends : {&uncertainty.low, &uncertainty.high}) {
      values.insert(values.end(), ends->begin(), ends->end());
      if (ends->empty())
        values.insert(values.end(), uncertainty.deviation.size(),
                      std::numeric_limits<double>::quiet_NaN());
    }
  values.insert(values.end(), uncertainty.offsets.begin(), uncertainty.offsets.end());
  for (const double value : values_of(trust_row(answer.data, answer.alpha.value), false))
    values.push_back(value);
  return values;
}

}  // namespace

std::vector<std::string> traction_columns(const lab::AnyProblem& problem) {
  if (const auto* skin = std::get_if<lab::SkinSceneProblem>(&problem))
    return traction_columns(skin->grid(), skin->layout().components);
  const auto& line = std::get<lab::SceneProblem>(problem);
  const std::size_t places = line.surface().count;
  return frames::traction_columns(places, line.tractions() > places);
}

std::vector<std::string> uncertainty_columns(const lab::AnyProblem& problem) {
  if (const auto* line = std::get_if<lab::SceneProblem>(&problem)) return line_columns(*line);
  return uncertainty_columns(std::get<lab::SkinSceneProblem>(problem));
}

std::vector<double> uncertainty_values(const lab::AnyProblem& problem,
                                       const lab::FrameAnswer& answer) {
  if (const auto* skin = std::get_if<lab::SkinSceneProblem>(&problem))
    return uncertainty_values(*skin, answer);
  return line_values(std::get<lab::SceneProblem>(problem), answer);
}

}  // namespace tactile_net::report
