#include <utility>

#include "study/circuits.hpp"

namespace tactile_net::study {

StudySection parts_floors(const StudyInput& input, const Stop& stop) {
  StudySection section;
  for (const Realization realization : realizations) {
    if (!traits(realization).linear() || !traits(realization).uses_opamps) continue;
    for (const double relative : {0.01, 0.001}) {
      if (stop()) return section;
      AnyScene scene = with_circuit(input, realization);
      network_of(scene).tolerance = ToleranceOptions{.relative = relative, .trials = 40};
      if (!is_small(scene)) continue;
      const lab::SceneCircuit circuit = circuit_of(input, scene);
      const ToleranceResult result = tolerate(circuit.network().reduction(), circuit.tolerance());
      PartsFloor floor{.realization = realization, .relative = relative};
      if (2 * result.stable > result.trials) floor.median = result.median;
      section.floors.push_back(std::move(floor));
    }
  }
  return section;
}

}  // namespace tactile_net::study
