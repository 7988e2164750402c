#include "commands/certify.hpp"

#include "commands/budget.hpp"
#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/pages/certificate_page.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::tool {

void run(const CertifyOptions& options, const Streams& streams) {
  decks::refuse_deck(options.scene);
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  Results results(options.results, streams);
  Progress progress(streams);
  const std::optional<double> budget = share_of(options.budget);
  const lab::Certification c = lab::certify(scene, progress, budget);
  results.write({.print = [&](std::ostream& out) { report::print_certificate(out, c); },
                 .json = [&] { return report::certificate_json(c); },
                 .page =
                     [&] {
                       return pages::certificate_html(
                           c, {.by = streams.command, .files = {"certificate.json"}});
                     },
                 .json_name = "certificate.json"},
                progress);
  if (c.certificate().stability == Stability::unstable ||
      c.certificate().stability == Stability::not_definite)
    throw CheckFailed("the circuit is not stable");
}

}  // namespace tactile_net::tool
