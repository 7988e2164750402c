#include <exception>

#include "study/circuits.hpp"
#include "study/points.hpp"
#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::study {

StudySection operating_points(const StudyInput& input, Simulator& simulator) {
  StudySection section;
  for (const Realization realization : realizations) {
    if (!traits(realization).linear()) continue;
    const AnyScene scene = with_circuit(input, realization);
    WorkPoint result;
    result.curve = curve_of(input, scene);
    result.knob = {.kind = Knob::Kind::operating_point};
    result.time_of = TimeOf::simulator;
    if (!is_small(scene)) {
      result.failure = Failure{.what = why_not_drawn(scene)};
      section.points.push_back(std::move(result));
      continue;
    }
    try {
      const lab::Relaxation relaxation = lab::relax(circuit_of(input, scene), simulator);
      result.seconds = result.seconds_low = result.seconds_high = relaxation.ngspice_seconds;
      result.error_to_solution = relaxation.difference;
      if (const auto disagreement = relaxation.disagreement())
        result.failure = Failure{.kind = Failure::Kind::disagrees, .disagreement = disagreement};
    } catch (const std::exception&) {
      result.failure = caught();
    }
    section.points.push_back(std::move(result));
  }
  return section;
}

}  // namespace tactile_net::study
