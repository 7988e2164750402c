#include "tactile_net/lab/simulated_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t first_build = 0;

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// A scene's refinement, and one build of it.
struct RefinedBuild {
  explicit RefinedBuild(const SceneCircuit& circuit)
      : options(*circuit.options().refine),
        tolerance(circuit.tolerance()),
        refinement(circuit.network(), tolerance, options),
        siemens(drawn(circuit.network().reduction(), tolerance, first_build)),
        volts(circuit.options().parts.scale.volts),
        range(largest(circuit.direct())) {}

  /// How many times as large as r currents have to be for the largest voltage to be that of the
  /// answer, as converters have it.
  [[nodiscard]] double size(std::span<const double> answer) const {
    const double most = largest(answer);
    return most > 0.0 ? range / most : 1.0;
  }

  RefinementOptions options;
  ToleranceOptions tolerance;
  Refinement refinement;
  std::vector<double> siemens;
  double volts;
  double range;
};

}  // namespace

bool SimulatedRefinement::agrees() const noexcept {
  constexpr double alike = 3.0;
  constexpr double arithmetic = 1e-12;  // errors below it are its own
  return !cycles.empty() && std::all_of(cycles.begin(), cycles.end(), [](const Cycle& one) {
    return one.simulated <= alike * one.numbers + arithmetic &&
           one.numbers <= alike * one.simulated + arithmetic;
  });
}

SimulatedRefinement refine(const SceneCircuit& circuit, Simulator& simulator, Observer& observer) {
  const RefinedBuild build(circuit);
  SimulatedRefinement result{.options = build.options, .drawn = build.tolerance};
  const Refined numbers = build.refinement.build(build.siemens, first_build);
  if (!numbers.stable) return result;
  std::vector<double> differences;
  const auto answered = [&](std::span<const double> sent) {
    observer.step({Step::Kind::operating_point});
    const std::vector<double> said = build.refinement.answer(build.siemens, sent);
    const double size = sent.empty() ? 1.0 : build.size(said);
    const Circuit built = build.refinement.circuit(build.siemens, sent, size);
    const OperatingPoint point = operating_point(simulator, built, circuit.file() + ", refined");
    result.simulator_seconds += point.seconds;
    std::vector<double> seen = point.voltages;
    for (double& one : seen) one /= build.volts * size;
    differences.push_back(l2_difference(seen, said));
    return seen;
  };
  const Refined simulated = build.refinement.build(build.siemens, first_build, answered);
  for (std::size_t k = 0; k < numbers.errors.size(); ++k)
    result.cycles.push_back({numbers.errors[k], simulated.errors[k], differences[k]});
  return result;
}

RefinementDeck refinement_deck(const SceneCircuit& circuit, std::size_t cycle) {
  RefinedBuild build(circuit);
  if (cycle == 0 || cycle > build.options.cycles)
    throw std::invalid_argument("refinement goes from cycle 1 to " +
                                std::to_string(build.options.cycles));
  RefinementDeck result{.cycle = cycle};
  std::size_t at = 0;
  const auto answered = [&](std::span<const double> sent) {
    std::vector<double> said = build.refinement.answer(build.siemens, sent);
    if (++at != cycle) return said;
    result.size = sent.empty() ? 1.0 : build.size(said);
    result.circuit = build.refinement.circuit(build.siemens, sent, result.size);
    result.expected = operating_voltages(result.circuit);
    return said;
  };
  const Refined refined = build.refinement.build(build.siemens, first_build, answered);
  if (!refined.stable)
    throw std::invalid_argument("the build that would be refined is not stable: " +
                                std::string(steadier_builds));
  if (cycle > 1) result.error = refined.errors[cycle - 2];
  return result;
}

}  // namespace tactile_net::lab
