#include "tactile_net/lab/certification.hpp"

#include "tactile_net/lab/beyond_curves.hpp"
#include "tactile_net/lab/workload.hpp"

namespace tactile_net::lab {

Certification certify(const AnyScene& scene, Observer& observer,
                      const CertificationOptions& wanted) {
  observer.step({Step::Kind::readings});
  Certification result{.circuit = simulated_circuit(scene),
                       .oscillating_board = wanted.oscillating_board};
  observer.step({Step::Kind::certificate});
  // Before all else, since a board of another circuit is refused.
  if (wanted.board != nullptr)
    result.board = certify_board(result.circuit, *wanted.board, wanted.phase_margin);
  result.motion = contact_motion(result.circuit);
  const NetworkOptions& options = result.circuit.options();
  if (traits(options.realization).parts == RealizationTraits::Parts::curved)
    result.curves = beyond_curves(result.circuit.explained());
  if (result.circuit.loaded() && calls_for_tolerance(options)) {
    observer.step({Step::Kind::draws});
    result.tolerance = tolerate(result.circuit.network(), *options.tolerance);
  }
  if (options.refine && result.circuit.loaded()) {
    observer.step({Step::Kind::draws});
    result.refinement = refinement(result.circuit);
  }
  observer.step({Step::Kind::realizations});
  result.recommendation = recommend(result.circuit);
  if (wanted.accuracy) result.parts = parts_list(result.circuit, *wanted.accuracy);
  if (result.parts && result.parts->choice) {
    observer.step({Step::Kind::board});
    result.board = close_board(result.circuit, *result.parts, wanted.phase_margin);
  }
  if (wanted.datasheet) {
    observer.step({Step::Kind::draws});
    result.datasheet = lab::datasheet(result.circuit, result.parts ? &*result.parts : nullptr,
                                      result.board ? &*result.board : nullptr);
  }
  return result;
}

}  // namespace tactile_net::lab
