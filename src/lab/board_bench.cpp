#include "tactile_net/lab/board_bench.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tactile_net::lab {
namespace {

constexpr std::size_t self_test_builds = 200;
constexpr double share_of_range = 0.9;

/// Of every part: the scene's.
std::vector<double> tolerances_of(const SceneCircuit& circuit) {
  const ToleranceOptions options = circuit.tolerance();
  const Reduction& reduction = circuit.network().reduction();
  std::vector<double> all(reduction.resistors().size(), options.relative.value_or(0.01));
  if (options.stabiliser)
    for (std::size_t r = 0; r < all.size(); ++r)
      if (reduction.resistors()[r].starts_with("Rs")) all[r] = *options.stabiliser;
  return all;
}

std::size_t part_named(const Reduction& reduction, std::string_view name) {
  const auto names = reduction.resistors();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::invalid_argument("the circuit has no resistor '" + std::string(name) +
                                "': its first is " + names.front() + ", and gen writes them all");
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

BenchVerdict BoardBench::verdict() const noexcept {
  // Of so many voltages the misfit's square has a deviation of sqrt(2/count).
  const auto count = static_cast<double>(patterns * outputs.size());
  const double most = std::sqrt(1.0 + 5.0 * std::sqrt(2.0 / std::max(count, 1.0)));
  if (diagnosis.named == 0)
    return diagnosis.misfit <= most ? BenchVerdict::healthy : BenchVerdict::not_explained;
  if (!(diagnosis.misfit_with_fault <= most)) return BenchVerdict::not_explained;
  return diagnosis.named == 1 ? BenchVerdict::faulty : BenchVerdict::not_told_apart;
}

BoardModel board_model(const SceneCircuit& circuit) {
  return {circuit.network().reduction(), board_inputs(circuit.network().circuit().sources),
          tolerances_of(circuit)};
}

BoardBench bench(const SceneCircuit& circuit, const BoardResponses& responses, Observer& observer) {
  const BoardModel board = board_model(circuit);
  const Reduction& reduction = circuit.network().reduction();
  BoardBench result{.outputs = output_names(circuit.network().circuit()),
                    .parts = {reduction.resistors().begin(), reduction.resistors().end()},
                    .patterns = responses.currents.rows,
                    .noise = responses.noise};
  for (const BoardInput& input : board.inputs()) result.inputs.push_back(input.name);
  observer.step({Step::Kind::draws});
  result.diagnosis = board.diagnose(responses);
  if (circuit.loaded())
    result.self_test = self_test(reduction, circuit.network().problem().matrix,
                                 circuit.network().problem().right_side, tolerances_of(circuit),
                                 self_test_builds, circuit.tolerance().seed);
  return result;
}

BoardFault planted_fault(const Reduction& reduction, std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  std::string kinds;
  for (const auto& row : Enumerators<PartFault>::all) {
    if (row.value == PartFault::other_value) continue;
    if (row.name != kind || colon == std::string_view::npos) {
      kinds += (kinds.empty() ? "" : ", ") + std::string(row.name);
      continue;
    }
    BoardFault fault{.kind = row.value};
    std::string_view part = text.substr(colon + 1);
    if (row.value == PartFault::swapped) {
      const std::size_t slash = part.find('/');
      if (slash == std::string_view::npos)
        throw std::invalid_argument("two parts are swapped: swapped:Rk1_2p/Rt0_3n");
      fault.other = part_named(reduction, part.substr(slash + 1));
      part = part.substr(0, slash);
    }
    fault.part = part_named(reduction, part);
    if (row.value == PartFault::swapped && fault.part == fault.other)
      throw std::invalid_argument("'" + std::string(text) +
                                  "' swaps a part with itself: name two parts");
    if (row.value == PartFault::ten_times) fault.factor = 0.1;
    if (row.value == PartFault::tenth) fault.factor = 10.0;
    if (row.value == PartFault::shorted) fault.factor = 1e6;
    return fault;
  }
  throw std::invalid_argument("'" + std::string(text) + "' is no fault: KIND:PART, such as open:" +
                              std::string(reduction.resistors().front()) + ", KIND one of " +
                              kinds);
}

BoardResponses simulated_board(const SceneCircuit& circuit, const PlantedBoard& planted) {
  const Reduction& reduction = circuit.network().reduction();
  const BoardModel board = board_model(circuit);
  ToleranceOptions options = circuit.tolerance();
  options.each = tolerances_of(circuit);
  options.series.reset();
  options.seed = planted.seed;
  std::vector<double> siemens = drawn(reduction, options, 0);
  for (const BoardFault& fault : planted.faults) siemens = with_fault(siemens, fault);
  const double volts = circuit.options().parts.opamp.rail.value_or(1.0);
  return simulated_responses(circuit.network().flat(), board.inputs(), siemens,
                             board.single_inputs(share_of_range * volts), planted.bits, volts,
                             planted.seed);
}

}  // namespace tactile_net::lab
