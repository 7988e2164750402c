#include "tactile_net/inverse/constrained.hpp"

#include <cstddef>
#include <stdexcept>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"

namespace tactile_net::study {
namespace {

/// One point for each limit of exchanges, until the optimum is found.
void add_active_sets(StudySection& section, const StudyInput& input, const WorkCurve& curve,
                     const lab::Clock& clock) {
  const ConstrainedTikhonov inverse(input.line().problem(), input.alpha,
                                    input.line().constraints().value_or(Constraints{}));
  for (std::size_t limit = 1; limit <= 64; limit *= 2) {
    ConstrainedSolution solution;
    const lab::Seconds seconds =
        lab::time_of([&] { solution = inverse.solve(input.readings, limit); }, 0.03, clock);
    if (solution.status != FrameStatus::ok)
      throw std::overflow_error("the readings' tractions overflow a double");
    const bool optimal = solution.verdict == ConstrainedVerdict::ok;
    WorkPoint result =
        point(input, curve,
              {.kind = Knob::Kind::exchanges, .count = solution.iterations, .optimal = optimal},
              solution.tractions, seconds);
    result.error_to_solution.reset();  // the constrained problem is another one
    section.points.push_back(std::move(result));
    if (optimal) break;
  }
}

}  // namespace

StudySection constrained(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::active_set};
  try {
    add_active_sets(section, input, curve, clock);
  } catch (const std::exception&) {
    section.points.push_back(failed(curve, {}, TimeOf::frame, caught()));
  }
  add_planned_constraints(section, input, input.line().constraints().value_or(Constraints{}),
                          clock);
  return section;
}

}  // namespace tactile_net::study
