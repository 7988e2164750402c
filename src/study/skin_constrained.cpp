#include <cstddef>
#include <stdexcept>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"

namespace tactile_net::study {

StudySection skin_constrained(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::friction_cone};
  try {
    const ConeTikhonov cone(input.skin().problem(), input.alpha,
                            input.constraints().value_or(Constraints{}));
    for (std::size_t limit = 5; limit <= 1280; limit *= 2) {
      ConeSolution solution;
      const lab::Seconds seconds =
          lab::time_of([&] { solution = cone.solve(input.readings, limit); }, 0.03, clock);
      if (solution.status != FrameStatus::ok) throw Failed({.kind = Failure::Kind::no_frame});
      const bool optimal = solution.verdict == ConstrainedVerdict::ok;
      WorkPoint result =
          point(input, curve,
                {.kind = Knob::Kind::steps, .count = solution.iterations, .optimal = optimal},
                solution.tractions, seconds);
      result.error_to_solution.reset();  // the constrained problem is another one
      section.points.push_back(std::move(result));
      if (optimal) break;
    }
  } catch (const std::exception&) {
    section.points.push_back(failed(curve, {}, TimeOf::frame, caught()));
  }
  add_planned_constraints(section, input, input.constraints().value_or(Constraints{}), clock);
  return section;
}

}  // namespace tactile_net::study
