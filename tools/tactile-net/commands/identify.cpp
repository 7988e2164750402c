#include "tactile_net/lab/identify.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands/commands.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/report/json/identify_json.hpp"
#include "tactile_net/report/pages/identify_page.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string folder;
  std::string json;
  lab::SurveyOptions survey;
};

void check_positive(const char* option, const std::optional<double>& value) {
  if (value && (!(*value > 0.0) || !std::isfinite(*value)))
    throw CLI::ValidationError(option, "must be > 0 and finite");
}

void print(std::ostream& out, const Scene& scene, const lab::Survey& survey) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << report::sensor_in_words(scene) << "; " << report::material_in_words(scene) << "\n\n";
  for (const std::string& sentence : report::verdict_in_words(survey)) out << sentence << '\n';
  out << '\n';
  for (const std::string& line : report::singular_values_in_words(survey.own.identifiability))
    out << line << '\n';
  out << '\n';
  report::print_cells(out, report::survey_cells(survey));
  out << report::cells_in_words(scene, survey) << '\n';
}

void run(const Options& options) {
  check_positive("--traction", options.survey.traction);
  check_positive("--noise", options.survey.relative_noise);
  const Scene scene = read_scene(options.scene);
  std::unique_ptr<frames::OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<frames::OutputFolder>(options.folder);

  Progress progress;
  const lab::Survey result = lab::identify(scene, options.survey, progress);
  if (folder) {
    progress.say("drawing the report ...");
    folder->write("result.json", report::survey_json(scene, result));
    write(*folder, report::survey_html(scene, result));
    folder->commit();
  }
  progress.clear();

  if (options.json != "-") print(std::cout, scene, result);
  if (!options.json.empty()) {
    frames::OutputFile output(options.json);
    output.stream() << report::survey_json(scene, result);
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
