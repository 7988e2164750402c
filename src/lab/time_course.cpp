#include "tactile_net/lab/time_course.hpp"

#include <algorithm>
#include <limits>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/simulated_frame.hpp"

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
  const std::span<const double> normal = std::span(f).first(count);
  const std::span<const double> tangential = std::span(f).subspan(count);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();

  TimeCourse course{.method = method, .tangential = !tangential.empty()};
  SensorRecording recording(whole);
  for (std::size_t k = 0; recording.next(k % stride == 0); ++k) {
    if (k % stride != 0) continue;
    course.time.push_back(recording.time());
    course.truth.push_back(pressed(scene, problem.surface(), recording.time(), recording.truth()));
    Resultant found{none, none, none};
    try {
      if (solver->solve(recording.readings(), f).status == FrameStatus::ok)
        found = resultant_of(normal, tangential, problem.surface());
      else
        std::fill(f.begin(), f.end(), none);
    } catch (const std::domain_error&) {  // its answer would be noise: a gap
      std::fill(f.begin(), f.end(), none);
    }
    course.tractions.insert(course.tractions.end(), f.begin(), f.end());
    course.found.push_back(found);
    observer.step({Step::Kind::frame, k});
  }
  return course;
}

}  // namespace tactile_net::lab
