#include <span>
#include <vector>

#include "study/digital.hpp"
#include "study/points.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"

namespace tactile_net::study {

StudySection factorisations(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const LinearProblem& problem = input.line().problem();
  const WorkCurve explicit_inverse{.family = WorkCurve::Family::closed_form};
  attempt(section, explicit_inverse, {}, [&] {
    const Reconstruction inverse = closed_form(problem, input.alpha);
    std::vector<double> f(inverse.tractions());
    const lab::Seconds seconds =
        lab::time_of([&] { (void)inverse.solve(input.readings, f); }, 0.03, clock);
    return point(input, explicit_inverse, {}, f, seconds);
  });
  const WorkCurve every_frame{.family = WorkCurve::Family::factorisation};
  attempt(section, every_frame, {}, [&] {
    std::vector<double> f;
    const lab::Seconds seconds = lab::time_of(
        [&] { f = tikhonov_solve(problem, input.alpha, input.readings); }, 0.03, clock);
    return point(input, every_frame, {}, f, seconds);
  });
  return section;
}

}  // namespace tactile_net::study
