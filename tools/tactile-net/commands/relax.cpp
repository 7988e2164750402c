#include "commands/relax.hpp"

#include <cmath>
#include <memory>

#include "commands/board_file.hpp"
#include "commands/input.hpp"
#include "commands/refine_options.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/decks/macromodel.hpp"
#include "tactile_net/lab/board_certificate.hpp"
#include "tactile_net/lab/macromodel_comparison.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/simulated_refinement.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/macromodel_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/refinement_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/opamp_part.hpp"

namespace tactile_net::tool {
namespace {

/// A header that allows more says nothing of the answer.
constexpr double most_that_proves = 0.1;

void run_deck(const RelaxOptions& options, Simulator& simulator, const Streams& streams) {
  if (options.network.any())
    throw WrongUsage("--realization, --bandwidth",
                     "are for scenes: the circuit of a deck is fixed");
  if (options.tolerance && !(*options.tolerance >= 0.0 && std::isfinite(*options.tolerance)))
    throw WrongUsage("--tolerance", "must be >= 0 and finite");
  Results results({.json = options.json}, streams);
  Progress progress(streams);
  progress.say("ngspice ...");
  decks::DeckAnswer answer = decks::relax_deck(options.scene, simulator);
  answer.within = options.tolerance.value_or(answer.within);
  results.write(
      {.print = [&](std::ostream& out) { report::print_deck_answer(out, options.scene, answer); },
       .json = [&] { return report::deck_answer_json(options.scene, answer); }},
      progress);
  if (!(answer.difference <= answer.within))
    throw CheckFailed("the deck's voltages differ from those its header expects by " +
                      brief(answer.difference) + " (allowed: " + brief(answer.within) + ")");
  if (!options.tolerance && answer.within > most_that_proves)
    throw CheckFailed("the deck agrees with a bound that proves nothing: its header allows " +
                      brief(answer.within) +
                      ", because the circuit's own parts make its answer uncertain; --tolerance "
                      "says what to allow");
}

void run_scene(const RelaxOptions& options, Simulator& simulator, const Streams& streams) {
  if (options.tolerance)
    throw WrongUsage("--tolerance",
                     "is for decks; a scene's circuit is judged by what its parts explain");
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  Results results({.json = options.json}, streams);
  Progress progress(streams);
  const lab::Relaxation relaxation =
      lab::relax(lab::circuit_on_board(scene, board_if(options.board)), simulator, progress);
  results.write({.print = [&](std::ostream& out) { report::print_relaxation(out, relaxation); },
                 .json = [&] { return report::relaxation_json(scene, relaxation); }},
                progress);
  if (const auto disagreement = relaxation.disagreement())
    throw CheckFailed(report::in_words(*disagreement));
}

void run_refinement(const RelaxOptions& options, Simulator& simulator, const Streams& streams) {
  AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  refine_as(options.refine, scene);
  Results results({.json = options.json}, streams);
  Progress progress(streams);
  const lab::SimulatedRefinement refined =
      lab::refine(lab::simulated_circuit(scene), simulator, progress);
  results.write({.print = [&](std::ostream& out) { report::print_refinement(out, refined); },
                 .json = [&] { return report::refinement_json(scene, refined); }},
                progress);
  if (!refined.agrees()) throw CheckFailed(report::in_words(refined).front());
}

/// Between its supply pins.
double supply_of(const tactile_net::NetworkOptions& network) {
  if (network.macromodel.supply) return *network.macromodel.supply;
  if (network.supply) return *network.supply;
  throw WrongUsage("--model",
                   "needs the op-amps' supply: under [network], opamp = { part = \"THS4551\", "
                   "supply = 5 }, or model = { supply = 5 }");
}

void run_macromodel(const RelaxOptions& options, const Streams& streams) {
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  Results results({.json = options.json}, streams);
  Progress progress(streams);
  const lab::SceneCircuit circuit = lab::circuit_on_board(scene, board_if(options.board));
  const tactile_net::NetworkOptions& network = circuit.options();
  const Circuit& built = circuit.network().circuit();
  if (built.amplifiers.empty())
    throw WrongUsage("--model", "stands for op-amps, and this circuit has none");
  const decks::Macromodel model = decks::read_macromodel(
      options.model, network.macromodel,
      network.opamp_part != nullptr ? network.opamp_part->name : std::string(),
      built.amplifiers.front().outputs, supply_of(network));
  lab::SimulatorChoice choice = options.simulator;
  choice.ngspice.pspice = true;
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(choice);
  decks::MacromodelSimulator with_model(*simulator, model, built);
  const lab::MacromodelComparison comparison =
      lab::compare_macromodel(circuit, with_model, model.name, progress);
  results.write({.print = [&](std::ostream& out) { report::print_macromodel(out, comparison); },
                 .json = [&] { return report::macromodel_json(scene, comparison); }},
                progress);
  if (comparison.verdict() != lab::MacromodelVerdict::as_certified)
    throw CheckFailed(report::in_words(comparison).front());
}

}  // namespace

void run(const RelaxOptions& options, const Streams& streams) {
  const bool deck = decks::is_deck(options.scene);
  if (deck && !options.board.empty())
    throw WrongUsage("--board", "is for scenes: gen --board writes a deck with a board's copper");
  if (!options.model.empty()) {
    if (deck) throw WrongUsage("--model", "is for scenes: a deck has the op-amps that it has");
    if (options.tolerance) throw WrongUsage("--tolerance", "is for decks");
    if (!options.refine.empty()) throw WrongUsage("--model", "is run by itself, without --refine");
    return run_macromodel(options, streams);
  }
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(options.simulator);
  if (!options.refine.empty()) {
    if (deck) throw WrongUsage("--refine", "is for scenes: gen --cycle writes a cycle's deck");
    if (options.tolerance) throw WrongUsage("--tolerance", "is for decks");
    if (!options.board.empty())
      throw WrongUsage("--board", "changes nothing of a refinement, whose answers are at rest");
    return run_refinement(options, *simulator, streams);
  }
  if (deck)
    run_deck(options, *simulator, streams);
  else
    run_scene(options, *simulator, streams);
}

}  // namespace tactile_net::tool
