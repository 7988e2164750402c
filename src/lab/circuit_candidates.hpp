/// @file
/// Which other circuits of a scene's problem could be built instead, for what compares them.
/// Private.
#pragma once

#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"

namespace tactile_net::lab {

/// Realisations of op-amps and resistors; converters a branch only while there are not tens of
/// thousands of them.
[[nodiscard]] inline std::vector<Realization> candidates(const SceneCircuit& circuit) {
  std::vector<Realization> result;
  for (const Realization one : realizations)
    if (traits(one).uses_opamps && traits(one).linear() && circuit.fits(one) &&
        (!traits(one).opamps_per_branch || circuit.nodes() <= 130))
      result.push_back(one);
  return result;
}

/// With the scene's own op-amps and scale, and complementary outputs.
[[nodiscard]] inline NetworkCircuit candidate(Realization realization,
                                              const SceneCircuit& circuit) {
  RealizationOptions parts = circuit.options().parts;
  parts.inverters = false;
  return {realization, circuit.network().shared_problem(), parts};
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
