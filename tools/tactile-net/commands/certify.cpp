#include "commands/certify.hpp"

#include "commands/budget.hpp"
#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/network/laid_board.hpp"
#include "tactile_net/pages/certificate_page.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/bounded_text.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::uintmax_t largest_board = std::uintmax_t{256} << 20U;

}  // namespace

void run(const CertifyOptions& options, const Streams& streams) {
  decks::refuse_deck(options.scene);
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
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
  std::optional<LaidBoard> board;
  if (!options.board.empty())
    board = read_kicad_board(
        bounded_text(options.board, largest_board, "is this the right file? boards have some MiB"),
        options.board);
  if (board) wanted.board = &*board;
  const lab::Certification c = lab::certify(scene, progress, wanted);
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
