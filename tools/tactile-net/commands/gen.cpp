#include "commands/gen.hpp"

#include <filesystem>
#include <string>
#include <utility>

#include "commands/board_file.hpp"
#include "commands/budget.hpp"
#include "commands/input.hpp"
#include "commands/refine_options.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/beyond_curves.hpp"
#include "tactile_net/lab/board_certificate.hpp"
#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/lab/simulated_refinement.hpp"
#include "tactile_net/report/words/deck_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/parts_words.hpp"

namespace tactile_net::tool {

namespace {

void run_cycle(const GenOptions& options, AnyScene scene, const Streams& streams) {
  const std::size_t cycle = *options.refine;
  if (options.budget || !options.board.empty() || !options.subcircuit.empty())
    throw WrongUsage("--refine",
                     "writes a build of the scene's own resistors at rest: leave out --budget, "
                     "--board and --subcircuit");
  refine_as({"cycles=" + std::to_string(cycle)}, scene);
  frames::OutputFile output(options.output, &streams.out);
  const lab::SceneCircuit circuit = lab::simulated_circuit(scene);
  output.stream() << report::deck_text(circuit, lab::refinement_deck(circuit, cycle),
                                       options.dialect);
  output.commit();
}

}  // namespace

void run(const GenOptions& options, const Streams& streams) {
  decks::refuse_deck(options.scene);
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  if (!options.symbol.empty() && options.subcircuit.empty())
    throw WrongUsage("--symbol", "needs a sub-circuit: name it, --subcircuit NAME");
  if (!options.symbol.empty() && (options.output.empty() || options.output == "-"))
    throw WrongUsage(
        "--symbol",
        "names the sub-circuit's file in the symbol: give that file, --output FILE.lib");
  if (options.refine) return run_cycle(options, scene, streams);
  const std::optional<double> budget = share_of(options.budget);
  frames::OutputFile output(options.output, &streams.out);
  const auto symbol = output_if(options.symbol, streams);

  const lab::SceneCircuit circuit = lab::circuit_on_board(scene, board_if(options.board));
  if (const auto curves = lab::beyond_curves(circuit.explained()))
    throw CheckFailed(report::in_words(*curves));
  std::optional<lab::PartsList> list;
  if (budget) {
    list = lab::own_parts_list(circuit, *budget);
    if (!list->choice) throw CheckFailed(report::in_words(*list));
  }
  const lab::PartsList* const parts = list ? &*list : nullptr;
  if (!options.subcircuit.empty())
    output.stream() << report::subcircuit_text(circuit, parts, options.subcircuit, options.dialect);
  else if (parts != nullptr)
    output.stream() << report::deck_text(circuit, *parts, options.dialect);
  else
    output.stream() << report::deck_text(circuit, Answer::printed, options.dialect);
  if (symbol) {
    const std::string file = std::filesystem::path(options.output).filename().string();
    symbol->stream() << report::symbol_text(circuit, parts, options.subcircuit, file);
    symbol->stream().flush();
  }
  // Both are on the disk before either has its name: none stays without the other.
  output.stream().flush();
  output.commit();
  if (symbol) symbol->commit();
}

}  // namespace tactile_net::tool
