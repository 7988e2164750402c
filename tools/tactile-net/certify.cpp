#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "experiment.hpp"
#include "failure.hpp"
#include "output.hpp"
#include "result_json.hpp"
#include "table.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string folder;
  std::string json;
  NetworkChoice network;
};

void run(const Options& options) {
  refuse_deck(options.scene);
  Scene scene = read_scene(options.scene);
  apply(options.network, scene);
  std::unique_ptr<OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<OutputFolder>(options.folder);
  Progress progress;
  const std::vector<double> readings = simulate(scene).readings;
  Certification c{.scene = scene, .plan = plan_circuit(scene, readings)};
  progress.step("certifying ...");
  c.certificate = certify(c.plan);
  if (c.loaded() && calls_for_tolerance(c.plan.options)) {
    progress.step("drawing components ...");
    c.tolerance = tolerate(c.plan);
  }
  progress.step("comparing realisations ...");
  if (c.loaded())
    c.recommendation = recommend(c.plan);
  else
    c.recommendation.text = "There is no load: nothing for errors of components to change.";
  if (folder) {
    progress.step("drawing the report ...");
    folder->write("certificate.json", certificate_json(c));
    write(*folder, certificate_html(c));
    folder->commit();
  }
  progress.clear();
  if (options.json != "-") print_certificate(std::cout, c);
  if (!options.json.empty()) {
    OutputFile output(options.json);
    output.stream() << certificate_json(c);
    output.commit();
  }
  if (folder && options.json != "-")
    std::cout << "report: " << (std::filesystem::path(options.folder) / "report.html").string()
              << '\n';
  if (c.certificate.stability == Stability::unstable ||
      c.certificate.stability == Stability::not_definite)
    throw CheckFailed("the circuit is not stable");
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
