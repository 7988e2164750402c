#include <algorithm>
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
  std::string json;
  NetworkChoice network;
};

void run(const Options& options) {
  refuse_deck(options.scene);
  Scene scene = read_scene(options.scene);
  apply(options.network, scene);
  Progress progress;
  const CircuitPlan plan = plan_circuit(scene, simulate(scene).readings);
  progress.step("certifying ...");
  const Certificate certificate = certify(plan);
  std::optional<ToleranceResult> tolerance;
  const bool loaded =
      std::any_of(plan.direct.begin(), plan.direct.end(), [](double f) { return f != 0.0; });
  if (loaded && calls_for_tolerance(plan.options)) {
    progress.step("drawing components ...");
    tolerance = tolerate(plan);
  }
  progress.step("comparing realisations ...");
  Recommendation recommendation;
  if (loaded)
    recommendation = recommend(plan);
  else
    recommendation.text = "There is no load: nothing for errors of components to change.";
  progress.clear();
  if (options.json != "-")
    print_certificate(std::cout, certificate, tolerance,
                      plan.options.tolerance.value_or(ToleranceOptions{}), recommendation);
  if (!options.json.empty()) {
    OutputFile output(options.json);
    output.stream() << certificate_json(scene, certificate, tolerance, recommendation);
    output.commit();
  }
  if (certificate.stability == Stability::unstable ||
      certificate.stability == Stability::not_definite)
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
  command->add_option("--json", options->json,
                      "Write the certificate as JSON (- = standard output)");
  add_network_options(*command, options->network);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
