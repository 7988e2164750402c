#include <filesystem>
#include <iostream>
#include <memory>

#include "commands/commands.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string folder;
  std::string json;
  NetworkChoice network;
};

void run(const Options& options) {
  lab::refuse_deck(options.scene);
  Scene scene = read_scene(options.scene);
  apply(options.network, scene);
  std::unique_ptr<frames::OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<frames::OutputFolder>(options.folder);
  Progress progress;
  const std::vector<double> readings = lab::simulate(scene).readings;
  lab::Certification c{.scene = scene, .plan = lab::plan_circuit(scene, readings)};
  progress.say("certifying ...");
  c.certificate = lab::certify(c.plan);
  if (c.loaded() && lab::calls_for_tolerance(c.plan.options)) {
    progress.say("drawing components ...");
    c.tolerance = lab::tolerate(c.plan);
  }
  progress.say("comparing realisations ...");
  if (c.loaded())
    c.recommendation = lab::recommend(c.plan);
  else
    c.recommendation.text = "There is no load: nothing for errors of components to change.";
  if (folder) {
    progress.say("drawing the report ...");
    folder->write("certificate.json", report::certificate_json(c));
    write(*folder, report::certificate_html(c));
    folder->commit();
  }
  progress.clear();
  if (options.json != "-") report::print_certificate(std::cout, c);
  if (!options.json.empty()) {
    frames::OutputFile output(options.json);
    output.stream() << report::certificate_json(c);
    output.commit();
  }
  if (folder && options.json != "-")
    std::cout << "report: " << (std::filesystem::path(options.folder) / "report.html").string()
              << '\n';
  if (c.certificate.stability == Stability::unstable ||
      c.certificate.stability == Stability::not_definite)
    throw frames::CheckFailed("the circuit is not stable");
}

}  // namespace

void add_certify(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "certify",
      "Say, without a simulator, whether the scene's circuit is stable, how fast it settles, which "
      "errors of components it bears, and which realisation to choose");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option("--out", options->folder,
                      "Folder for report.html, certificate.json and the plots' data (CSV)");
  command->add_option("--json", options->json,
                      "Write the certificate as JSON (- = standard output)");
  add_network_options(*command, options->network);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
