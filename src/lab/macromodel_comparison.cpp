#include "tactile_net/lab/macromodel_comparison.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::lab {
namespace {

constexpr double alike_at_rest = 0.1;
constexpr double alike_in_time = 0.2;

}  // namespace

MacromodelVerdict MacromodelComparison::verdict() const noexcept {
  if (!(difference <= alike_at_rest)) return MacromodelVerdict::answers_otherwise;
  const bool certified = certificate.dynamics && certificate.dynamics->slowest < 0.0;
  switch (transient.end) {
    case TransientEnd::grows:
      return certified ? MacromodelVerdict::does_not_settle : MacromodelVerdict::as_certified;
    case TransientEnd::settles:
      break;
    case TransientEnd::unsettled:
      // Bounded by its supply: how an amplifier oscillates, or settles late.
      return certified ? MacromodelVerdict::does_not_settle : MacromodelVerdict::as_certified;
    case TransientEnd::unfinished:
      return MacromodelVerdict::not_known;
  }
  if (!certified) return MacromodelVerdict::settles_uncertified;
  const double said = certificate.dynamics->settling_seconds.value_or(0.0);
  const double seen = transient.settling_seconds.value_or(0.0);
  return std::abs(seen - said) <= alike_in_time * said ? MacromodelVerdict::as_certified
                                                       : MacromodelVerdict::settles_otherwise;
}

MacromodelComparison compare_macromodel(const SceneCircuit& scene_circuit, Simulator& with_model,
                                        std::string name, Observer& observer) {
  const Circuit& circuit = scene_circuit.network().circuit();
  if (circuit.amplifiers.empty())
    throw std::invalid_argument("a macromodel stands for op-amps, and this circuit has none");
  if (!scene_circuit.loaded())
    throw std::invalid_argument("without a load there is nothing to settle to");
  MacromodelComparison result{.macromodel = std::move(name),
                              .names = output_names(circuit),
                              .certificate = scene_circuit.certificate()};
  if (!result.certificate.dynamics)
    throw std::invalid_argument(
        "the certificate knows no poles of this circuit to compare with: its op-amps need a "
        "bandwidth, and it at most 1500 states");
  observer.step({Step::Kind::operating_point});
  result.voltages =
      operating_point(with_model, circuit, scene_circuit.file() + ", with " + result.macromodel,
                      scene_circuit.analysis())
          .voltages;
  std::vector<double> tractions = result.voltages;
  for (double& one : tractions) one /= scene_circuit.options().parts.scale.volts;
  result.difference = l2_difference(tractions, scene_circuit.direct());
  observer.step({Step::Kind::transient, result.certificate.dynamics->states});
  result.transient = settle(with_model, circuit, result.certificate, result.voltages);
  return result;
}

}  // namespace tactile_net::lab
