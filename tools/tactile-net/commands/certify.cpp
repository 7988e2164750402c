#include "commands/certify.hpp"

#include "failure.hpp"
#include "tactile_net/lab/deck_file.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/pages/certificate_page.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {

void run(const CertifyOptions& options, const Streams& streams) {
  lab::refuse_deck(options.scene);
  Scene scene = read_scene(options.scene);
  apply(options.network, scene, streams.err);
  Results results(options.results, streams);
  Progress progress(streams);
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
  results.write({.print = [&](std::ostream& out) { report::print_certificate(out, c); },
                 .json = [&] { return report::certificate_json(c); },
                 .page = [&] { return report::certificate_html(c); },
                 .json_name = "certificate.json"},
                progress);
  if (c.certificate.stability == Stability::unstable ||
      c.certificate.stability == Stability::not_definite)
    throw CheckFailed("the circuit is not stable");
}

}  // namespace tactile_net::tool
