#include "commands/certify.hpp"

#include "commands/board_file.hpp"
#include "commands/budget.hpp"
#include "commands/input.hpp"
#include "commands/refine_options.hpp"
#include "failure.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/pages/certificate_page.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/ordered_scene.hpp"

namespace tactile_net::tool {
namespace {

/// The scene of what is ordered, from which gen, relax, bench and `certify --board` go on.
std::string ordered_text(const InputText& text, const lab::Certification& c,
                         const std::string& by) {
  const lab::PartsList::Candidate& chosen = c.parts->chosen();
  OrderedCircuit ordered{.realization = chosen.realization, .ladder = chosen.ladder};
  if (c.board && c.board->changed())
    ordered.siemens = c.board->used.siemens / c.board->siemens_unit;
  return ordered_scene(text.text, parse_any_scene(text.text, text.name), ordered, by);
}

}  // namespace

void run(const CertifyOptions& options, const Streams& streams) {
  decks::refuse_deck(options.scene);
  const InputText text = input_text(options.scene, streams.in);
  AnyScene scene = circuit_scene(text, options.network, streams);
  refine_as(options.refine, scene);
  Results results(options.results, streams);
  Progress progress(streams);
  lab::CertificationOptions wanted{.accuracy = share_of(options.budget),
                                   .phase_margin = options.phase_margin,
                                   .oscillating_board = options.oscillating_board,
                                   .datasheet = options.datasheet};
  if (!(wanted.phase_margin > 0.0 && wanted.phase_margin < 90.0))
    throw WrongUsage("--phase-margin", "must be > 0 and below 90 degrees");
  if (!options.board.empty() && wanted.accuracy)
    throw WrongUsage("--board", "reads a board, and --budget makes a new one: name one of the two");
  const std::optional<LaidBoard> board = board_if(options.board);
  if (board) wanted.board = &*board;
  const lab::Certification c = lab::certify(scene, progress, wanted);
  results.write({.print = [&](std::ostream& out) { report::print_certificate(out, c); },
                 .json = [&] { return report::certificate_json(c); },
                 .page =
                     [&] {
                       pages::Made made{.by = streams.command, .files = {"certificate.json"}};
                       if (!c.writes_board()) return pages::certificate_html(c, made);
                       made.files.push_back(ordered_scene_file(text.name));
                       drawing::Page page = pages::certificate_html(c, made);
                       page.files.emplace_back(made.files.back(),
                                               ordered_text(text, c, streams.command));
                       return page;
                     },
                 .json_name = "certificate.json"},
                progress);
  if (c.certificate().stability == Stability::unstable ||
      c.certificate().stability == Stability::not_definite)
    throw CheckFailed("the circuit is not stable");
  if (c.board && c.board->soldered().oscillates()) {
    if (!options.board.empty()) throw CheckFailed("the circuit oscillates on this board");
    if (!c.writes_board())
      throw CheckFailed(
          "the circuit oscillates on its board, so board.kicad_pcb is not written; "
          "--oscillating-board writes it all the same");
  }
  if (c.datasheet && !c.datasheet->passes())
    throw CheckFailed("the datasheet misses a limit that the scene states");
}

}  // namespace tactile_net::tool
