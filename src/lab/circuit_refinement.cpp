#include "tactile_net/lab/circuit_refinement.hpp"

#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net::lab {
namespace {

using Way = CircuitRefinement::Way;

/// What the circuit alone, better parts, refinement and numbers come to.
std::vector<Way> ways_of(const SceneCircuit& circuit, const CircuitRefinement& found) {
  const NetworkOptions& options = circuit.options();
  const AllocationOptions typical;
  const auto& classes = options.resistor_classes ? *options.resistor_classes : typical.classes;
  const ElementCounts elements = count_elements(circuit.network().flat());
  const auto opamps =
      static_cast<double>(elements.opamps) * options.opamp_price.value_or(PartsList{}.opamp_price);
  const auto resistors = static_cast<double>(elements.resistors);
  const auto channels = static_cast<double>(circuit.nodes());
  const RefinementTrials& trials = found.trials;

  const double tolerance = found.drawn.relative.value_or(0.0);
  const bool soldered = tolerance > 0.0 && !found.drawn.bits && !found.drawn.stabiliser;
  Way by_itself{.kind = Way::Kind::alone,
                .tolerance = soldered ? tolerance : 0.0,
                .error = trials.cycles.front().p95,
                .seconds = found.settling_seconds};
  // The coarsest class that is as exact.
  for (const PartClass& sold : classes)
    if (soldered && !by_itself.price && sold.tolerance <= tolerance)
      by_itself.price = resistors * sold.price + opamps;
  std::vector<Way> ways = {by_itself};
  if (soldered)
    for (const PartClass& sold : classes)
      if (sold.tolerance < tolerance)
        ways.push_back({.kind = Way::Kind::better_parts,
                        .tolerance = sold.tolerance,
                        .error = by_itself.error * sold.tolerance / tolerance,
                        .price = resistors * sold.price + opamps,
                        .seconds = found.settling_seconds});

  const std::size_t cycles = trials.p95_cycles.value_or(trials.cycles.size());
  const auto later = static_cast<double>(cycles - 1);
  Way refined{.kind = Way::Kind::refined,
              .tolerance = by_itself.tolerance,
              .error = trials.cycles[cycles - 1].p95,
              .products = (cycles - 1) * trials.cycle_products,
              .cycles = cycles};
  if (by_itself.price)
    refined.price = *by_itself.price + channels * (to_circuit_price + from_circuit_price);
  if (found.settling_seconds && found.options.converters)
    refined.seconds = (1.0 + later) * *found.settling_seconds +
                      (1.0 + 2.0 * later) * found.options.converters->conversion;
  ways.push_back(refined);
  ways.push_back({.kind = Way::Kind::numbers,
                  .error = trials.double_floor,
                  .products = trials.frame_products});
  return ways;
}

}  // namespace

CircuitRefinement refinement(const SceneCircuit& circuit) {
  CircuitRefinement result{.options = *circuit.options().refine, .drawn = circuit.tolerance()};
  const Refinement refined(circuit.network(), result.drawn, result.options);
  result.bound = refined.bound();
  result.trials = refined.trials();
  const Certificate& certificate = circuit.certificate();
  result.verdict = verdict(result.bound, result.trials, certificate.stability == Stability::stable);
  result.proven_cycles =
      proven_cycles(result.bound, result.trials, result.verdict, result.options.accuracy);
  if (certificate.dynamics) result.settling_seconds = certificate.dynamics->settling_seconds;
  result.ways = ways_of(circuit, result);
  return result;
}

}  // namespace tactile_net::lab
