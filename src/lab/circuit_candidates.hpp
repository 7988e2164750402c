/// @file
/// Which other circuits of a scene's problem could be built instead, for what compares them.
/// Private.
#pragma once

#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"

namespace tactile_net::lab {

/// A realisation, and whether it is the form with a ladder.
struct CircuitForm {
  Realization realization = Realization::ideal;
  bool ladder = false;
};

/// Of a circuit as its scene has it.
[[nodiscard]] inline CircuitForm form_of(const NetworkCircuit& circuit) {
  return {circuit.realization(), has_ladder(circuit.realization(), circuit.options())};
}

/// Whether draws of a ladder, judged by the poles of all its amplifiers, take seconds at most.
[[nodiscard]] inline bool is_small_ladder(const SceneCircuit& circuit) {
  return circuit.nodes() + circuit.network().problem().kernel.rows <= 260;
}

/// Realisations of op-amps and resistors, with a ladder after without; converters a branch only
/// while there are not tens of thousands of them.
[[nodiscard]] inline std::vector<CircuitForm> candidates(const SceneCircuit& circuit) {
  std::vector<CircuitForm> result;
  for (const Realization one : realizations)
    if (traits(one).uses_opamps && traits(one).linear() && circuit.fits(one) &&
        (!traits(one).opamps_per_branch || circuit.nodes() <= 130)) {
      result.push_back({one});
      if (has_ladder(one, {.ladder = true}) && is_small_ladder(circuit))
        result.push_back({one, true});
    }
  return result;
}

/// With the scene's own op-amps and scale, and complementary outputs.
[[nodiscard]] inline NetworkCircuit candidate(const CircuitForm& form,
                                              const SceneCircuit& circuit) {
  RealizationOptions parts = circuit.options().parts;
  parts.inverters = false;
  parts.ladder = form.ladder;
  return {form.realization, circuit.network().shared_problem(), parts};
}

/// Draws of parts take op-amps for infinitely fast. Op-amps of one pole leave no candidate unstable
/// that its theorem speaks of; with more of them its poles are asked.
[[nodiscard]] inline bool is_stable_with_its_opamps(const NetworkCircuit& circuit) {
  const OpAmp& opamp = circuit.options().opamp;
  return (!opamp.second_pole && !opamp.input_capacitance && !opamp.output_resistance &&
          !opamp.common_mode_rejection) ||
         certify(circuit).stability != Stability::unstable;
}

}  // namespace tactile_net::lab
