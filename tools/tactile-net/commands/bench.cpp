#include "commands/bench.hpp"

#include <cmath>
#include <stdexcept>

#include "failure.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/frames/board_file.hpp"
#include "tactile_net/lab/board_bench.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/pages/bench_page.hpp"
#include "tactile_net/report/json/board_bench_json.hpp"
#include "tactile_net/report/words/board_bench_words.hpp"

namespace tactile_net::tool {
namespace {

std::vector<std::string> input_names(const BoardModel& board) {
  std::vector<std::string> names;
  for (const BoardInput& one : board.inputs()) names.push_back(one.name);
  return names;
}

void simulate_board(const BenchOptions& options, const lab::SceneCircuit& circuit,
                    const BoardModel& board, const Streams& streams) {
  const std::size_t bits = options.bits.value_or(12);
  if (bits < 4 || bits > 24) throw WrongUsage("--bits", "must be a whole number from 4 to 24");
  lab::PlantedBoard planted{.bits = static_cast<int>(bits), .seed = options.seed.value_or(1)};
  for (const std::string& text : options.faults) {
    try {
      planted.faults.push_back(lab::planted_fault(circuit.network().reduction(), text));
    } catch (const std::invalid_argument& error) {
      throw WrongUsage("--fault", error.what());
    }
  }
  const auto file = output_if(options.simulate, streams);
  write(file.get(),
        frames::board_file(input_names(board), output_names(circuit.network().circuit()),
                           lab::simulated_board(circuit, planted)));
}

}  // namespace

void run(const BenchOptions& options, const Streams& streams) {
  decks::refuse_deck(options.scene);
  if (options.noise && !(*options.noise > 0.0 && std::isfinite(*options.noise)))
    throw WrongUsage("--noise", "must be > 0 and finite");
  const bool simulated = !options.simulate.empty();
  if (!simulated && !options.faults.empty())
    throw WrongUsage("--fault", "is of a board that is simulated: --simulate");
  if (simulated != options.measured.empty())
    throw WrongUsage("MEASURED", simulated ? "is read, and --simulate writes such a file: one of "
                                             "the two"
                                           : "is missing: a CSV file of what was measured; "
                                             "--simulate FILE writes an example");
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  const lab::SceneCircuit circuit = lab::simulated_circuit(scene);
  const BoardModel board = lab::board_model(circuit);
  if (simulated) return simulate_board(options, circuit, board, streams);

  Results results(options.results, streams);
  Progress progress(streams);
  const BoardResponses responses = frames::read_board_file(
      options.measured, input_names(board), output_names(circuit.network().circuit()),
      options.noise.value_or(0.0));
  const lab::BoardBench bench = lab::bench(circuit, responses, progress);
  results.write({.print = [&](std::ostream& out) { report::print_bench(out, bench); },
                 .json = [&] { return report::bench_json(scene, bench); },
                 .page =
                     [&] {
                       return pages::bench_html(scene, bench,
                                                {.by = streams.command, .files = {"bench.json"}});
                     },
                 .json_name = "bench.json"},
                progress);
  if (bench.verdict() != lab::BenchVerdict::healthy)
    throw CheckFailed(report::in_words(bench).front());
}

}  // namespace tactile_net::tool
