#include <cstddef>
#include <utility>
#include <vector>

#include "study/digital.hpp"
#include "study/points.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"
#include "tactile_net/lab/method.hpp"

namespace tactile_net::study {
namespace {

WorkPoint ring_filter(const StudyInput& input, const WorkCurve& curve, const lab::Clock& clock) {
  const Scene& scene = input.line().scene();
  DftTikhonov inverse(scene.sensor, scene.material, input.line().options());
  std::vector<double> f(input.solution.size());
  const lab::Seconds seconds =
      lab::time_of([&] { (void)inverse.solve(input.readings, input.alpha, f); }, 0.03, clock);
  return point(input, curve, {}, f, seconds);
}

WorkPoint division(const StudyInput& input, const WorkCurve& curve, const lab::Clock& clock) {
  const auto solver = lab::make_solver(input.line(), Method::dft, input.alpha);
  std::vector<double> f(solver->tractions());
  const lab::Seconds seconds =
      lab::time_of([&] { (void)solver->solve(input.readings, f); }, 0.03, clock);
  WorkPoint result = point(input, curve, {}, f, seconds);
  result.error_to_solution.reset();  // it solves K f = g, another problem
  return result;
}

/// One more step for each point, until rounding is all that is left.
void add_conjugate_gradients(StudySection& section, const StudyInput& input, const WorkCurve& curve,
                             const lab::Clock& clock) {
  const Scene& scene = input.line().scene();
  FftTikhonov inverse(scene.sensor, scene.material, input.line().options(), input.alpha);
  std::vector<double> f(inverse.tractions());
  double before = 1.0;
  for (std::size_t steps = 1; steps <= 20; ++steps) {
    const auto frame = [&] { (void)inverse.solve(input.readings, f, 1e-300, steps); };
    const lab::Seconds seconds = lab::time_of(frame, 0.01, clock);
    WorkPoint next = point(input, curve, {.kind = Knob::Kind::steps, .count = steps}, f, seconds);
    const double now = *next.error_to_solution;
    if (before < 1e-12 && !(now < 0.5 * before)) break;
    section.points.push_back(std::move(next));
    before = now;
  }
}

}  // namespace

StudySection by_fft(const StudyInput& input, const lab::Clock& clock) {
  using Family = WorkCurve::Family;
  StudySection section;
  const WorkCurve ring{.family = Family::ring_filter};
  attempt(section, ring, {}, [&] { return ring_filter(input, ring, clock); });
  const WorkCurve quotient{.family = Family::division};
  if (unknowns(input.line().scene()) == 1)
    attempt(section, quotient, {}, [&] { return division(input, quotient, clock); });
  const WorkCurve iteration{.family = Family::conjugate_gradients};
  try {
    add_conjugate_gradients(section, input, iteration, clock);
  } catch (const std::exception&) {
    section.points.push_back(failed(iteration, {}, TimeOf::frame, caught()));
  }
  return section;
}

}  // namespace tactile_net::study
