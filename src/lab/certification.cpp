#include "tactile_net/lab/certification.hpp"

#include "tactile_net/lab/beyond_curves.hpp"
#include "tactile_net/lab/workload.hpp"

namespace tactile_net::lab {

Certification certify(const AnyScene& scene, Observer& observer, std::optional<double> accuracy) {
  observer.step({Step::Kind::readings});
  Certification result{.circuit = simulated_circuit(scene)};
  observer.step({Step::Kind::certificate});
  result.motion = contact_motion(result.circuit);
  const NetworkOptions& options = result.circuit.options();
  if (traits(options.realization).parts == RealizationTraits::Parts::curved)
    result.curves = beyond_curves(result.circuit.explained());
  if (result.circuit.loaded() && calls_for_tolerance(options)) {
    observer.step({Step::Kind::draws});
    result.tolerance = tolerate(result.circuit.network(), *options.tolerance);
  }
  observer.step({Step::Kind::realizations});
  result.recommendation = recommend(result.circuit);
  if (accuracy) result.parts = parts_list(result.circuit, *accuracy);
  return result;
}

}  // namespace tactile_net::lab
