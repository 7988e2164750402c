#include "tactile_net/lab/time_course.hpp"

#include <algorithm>
#include <limits>

#include "lab/own_tractions.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/uncertainty.hpp"

namespace tactile_net::lab {
namespace {

/// The contacts' forces, exact; they act where the sampled truth says.
Resultant pressed(const Scene& scene, const Surface& surface, double time,
                  const TractionField& truth) {
  const Resultant sampled = resultant_of(truth.normal, truth.tangential, surface);
  Resultant exact;
  for (const Contact& contact : contacts_at(scene, time)) {
    exact.normal += resultant(contact, Traction::normal);
    exact.tangential += resultant(contact, Traction::tangential_y);
  }
  exact.moment = sampled.centre().value_or(0.0) * exact.normal;
  return exact;
}

/// Of a frame that its mixture answers, under constraints too.
ResultantIntervals intervals_of(const SceneFrame& frame) {
  const double level = frame.problem().scene().interval_level;
  const ResultantDistributions known = resultant_distributions(frame);
  const auto interval = [&](const std::optional<Distribution>& one) {
    return one ? std::optional(one->interval(level)) : std::nullopt;
  };
  return {.normal = known.normal.interval(level),
          .tangential = interval(known.tangential),
          .centre = interval(known.centre)};
}

}  // namespace

TimeCourse time_course(const SceneProblem& problem, Method method, Observer& observer) {
  const Scene& scene = problem.scene();
  constexpr std::size_t most = 400;
  const std::size_t frames = scene.time->frames;
  const std::size_t stride = (frames + most - 1) / most;
  const Scene whole = at_frame(scene, frames - 1);
  const std::unique_ptr<FrameSolver> solver = make_solver(problem, method);
  const std::size_t count = problem.surface().count;
  std::vector<double> f(solver->tractions());
  constexpr double none = std::numeric_limits<double>::quiet_NaN();

  const bool by_mixture = method == Method::tikhonov && problem.answers_by_mixture();
  TimeCourse course{.method = method, .tangential = f.size() > count};
  SensorRecording recording(whole);
  for (std::size_t k = 0; recording.next(k % stride == 0); ++k) {
    if (k % stride != 0) continue;
    course.time.push_back(recording.time());
    course.truth.push_back(pressed(scene, problem.surface(), recording.time(), recording.truth()));
    Resultant found{none, none, none};
    ResultantIntervals intervals;
    try {
      const bool bound = !by_mixture || problem.constraints();
      if (bound && solver->solve(recording.readings(), f).status != FrameStatus::ok) {
        std::fill(f.begin(), f.end(), none);
      } else if (by_mixture) {
        const SceneFrame frame(problem, recording.readings());
        const std::vector<double> mean = frame.mixture()->mean();
        const OwnTractions own(problem);
        if (!bound) f = own.of(mean);
        const std::span<const double> all = mean;
        found =
            resultant_of(all.first(own.grid().count), all.subspan(own.grid().count), own.grid());
        intervals = intervals_of(frame);
      } else {
        found =
            resultant_of(std::span(f).first(count), std::span(f).subspan(count), problem.surface());
      }
    } catch (const std::domain_error&) {  // its answer would be noise: a gap
      std::fill(f.begin(), f.end(), none);
    }
    course.tractions.insert(course.tractions.end(), f.begin(), f.end());
    course.found.push_back(found);
    if (by_mixture) course.intervals.push_back(intervals);
    observer.step({Step::Kind::frame, k});
  }
  return course;
}

}  // namespace tactile_net::lab
