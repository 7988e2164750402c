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

std::string tractions_csv(std::vector<double> normal, std::span<const double> tangential) {
  const std::vector<std::string> columns =
      frames::traction_columns(normal.size(), !tangential.empty());
  normal.insert(normal.end(), tangential.begin(), tangential.end());
  return csv(columns, normal);
}

}  // namespace

drawing::Files run_files(const lab::Experiment& experiment) {
  const TractionField& truth = experiment.frame.truth;
  drawing::Files files;
  files.emplace_back("readings.csv", csv(frames::reading_columns(experiment.scene.sensor),
                                         raw_numbers(experiment.scene, experiment.frame.readings)));
  files.emplace_back("truth.csv", tractions_csv(truth.normal, truth.tangential));
  for (const lab::MethodResult& result : experiment.results)
    if (result.has_answer())
      files.emplace_back("tractions-" + std::string(name(result.method)) + ".csv",
                         tractions_csv(result.normal.traction, result.tangential.traction));
  if (experiment.circuit)
    files.emplace_back("network.cir", deck_text(*experiment.circuit, tactile_net::Answer::printed));
  return files;
}

}  // namespace tactile_net::report
