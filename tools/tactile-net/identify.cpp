#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "survey.hpp"
#include "survey_json.hpp"
#include "survey_report.hpp"
#include "table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "text.hpp"
#include "verdict.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string folder;
  std::string json;
  SurveyOptions survey;
};

void check_positive(const char* option, const std::optional<double>& value) {
  if (value && (!(*value > 0.0) || !std::isfinite(*value)))
    throw CLI::ValidationError(option, "must be > 0 and finite");
}

void print(std::ostream& out, const Scene& scene, const Survey& survey) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << "\n\n";
  for (const std::string& sentence : verdict_in_words(survey, scene)) out << sentence << '\n';
  out << '\n';
  for (const std::string& line : singular_values_in_words(survey.own.identifiability))
    out << line << '\n';
  out << '\n';
  print_cells(out, survey_cells(survey));
  out << cells_in_words(scene, survey) << '\n';
}

void run(const Options& options) {
  check_positive("--traction", options.survey.traction);
  check_positive("--noise", options.survey.relative_noise);
  const Scene scene = read_scene(options.scene);
  std::unique_ptr<OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<OutputFolder>(options.folder);

  Progress progress;
  const Survey result = survey(scene, options.survey, progress);
  if (folder) {
    progress.step("drawing the report ...");
    folder->write("result.json", survey_json(scene, result));
    write(*folder, survey_html(scene, result));
    folder->commit();
  }
  progress.clear();

  if (options.json != "-") print(std::cout, scene, result);
  if (!options.json.empty()) {
    OutputFile output(options.json);
    output.stream() << survey_json(scene, result);
    output.commit();
  }
  if (folder && options.json != "-")
    std::cout << "report: " << (std::filesystem::path(options.folder) / "report.html").string()
              << '\n';
}

}  // namespace

void add_identify(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "identify",
      "Before any reading: which tractions the scene's sensors can tell apart, and which others "
      "could");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option("--out", options->folder,
                      "Folder for report.html, result.json and the plots' data (CSV)");
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  command->add_option("--traction", options->survey.traction,
                      "Amplitude of the ripple to be told (default: the contacts' peak, or 1)");
  command->add_option("--noise", options->survey.relative_noise,
                      "Noise of every reading, over the largest that such a ripple causes "
                      "(default: the scene's rms, or 0.01)");
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
