#include "tactile_net/report/csv/uncertainty_csv.hpp"

#include <limits>
#include <optional>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::report {

std::vector<std::string> uncertainty_columns(const lab::SceneProblem& problem) {
  std::vector<std::string> columns;
  for (const std::string name : {"normal_force", "tangential_force", "centre", "angle"}) {
    columns.push_back(name);
    columns.push_back(name + "_deviation");
  }
  columns.emplace_back("residual_rms");
  columns.emplace_back("model_rms");
  for (std::string& traction :
       frames::traction_columns(problem.surface().count, problem.options().unknowns > 1))
    columns.push_back(traction.insert(traction.find('_'), "_deviation"));
  if (problem.options().unknown_offsets)
    for (const Channel& channel : channels(problem.scene().sensor))
      columns.push_back("offset_" + channel.name);
  columns.emplace_back("data");
  columns.emplace_back("alpha");
  columns.emplace_back("verdict");
  return columns;
}

std::vector<double> uncertainty_values(const lab::FrameUncertainty& uncertainty,
                                       const std::optional<DataVerdict>& data, double alpha) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  const auto add = [&](const std::optional<Uncertain>& number) {
    values.push_back(number ? number->value : unknown);
    values.push_back(number ? number->deviation : unknown);
  };
  const UncertainResultant& resultant = uncertainty.resultant;
  add(resultant.normal);
  add(resultant.tangential);
  add(resultant.centre);
  add(resultant.angle);
  values.push_back(uncertainty.noise.residual_rms);
  values.push_back(uncertainty.noise.model_rms);
  values.insert(values.end(), uncertainty.deviation.begin(), uncertainty.deviation.end());
  values.insert(values.end(), uncertainty.offsets.begin(), uncertainty.offsets.end());
  values.push_back(!data                ? unknown
                   : data->consistent() ? 0.0
                                        : 1.0 + static_cast<double>(data->doubts.front()));
  values.push_back(alpha);
  return values;
}

}  // namespace tactile_net::report
