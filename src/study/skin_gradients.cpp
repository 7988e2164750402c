#include <cstddef>
#include <stdexcept>
#include <vector>

#include "study/digital.hpp"
#include "study/matrix_gradients.hpp"
#include "study/points.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net::study {
namespace {

constexpr std::size_t most_steps = 200;

/// A point for 1, 2, 3, 4, 6, 9, ... steps, until rounding is all that is left.
///
/// @param solve  the tractions after so many steps, into its second argument
void add_steps(StudySection& section, const StudyInput& input, const WorkCurve& curve,
               const lab::Clock& clock, const auto& solve) {
  std::vector<double> f(input.solution.size());
  double before = 1.0;
  for (std::size_t steps = 1; steps <= most_steps; steps += steps < 4 ? 1 : steps / 2) {
    const lab::Seconds seconds = lab::time_of(
        [&] {
          if (solve(steps, f) != FrameStatus::ok) throw Failed({.kind = Failure::Kind::no_frame});
        },
        0.01, clock);
    WorkPoint next = point(input, curve, {.kind = Knob::Kind::steps, .count = steps}, f, seconds);
    const double now = *next.error_to_solution;
    if (before < 1e-9 && !(now < 0.5 * before)) break;
    section.points.push_back(std::move(next));
    if (now <= input.resolution()) break;
    before = now;
  }
}

void attempt_all(StudySection& section, const WorkCurve& curve, const auto& work) {
  try {
    work();
  } catch (const std::exception&) {
    section.points.push_back(failed(curve, {}, TimeOf::frame, caught()));
  }
}

}  // namespace

StudySection skin_gradients(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const lab::SkinSceneProblem& skin = input.skin();
  const WorkCurve by_fft{.family = WorkCurve::Family::conjugate_gradients};
  attempt_all(section, by_fft, [&] {
    LargeSkinTikhonov inverse(skin.scene().sensor, skin.scene().material, skin.options(),
                              input.alpha);
    add_steps(section, input, by_fft, clock, [&](std::size_t steps, std::span<double> f) {
      return inverse.solve(input.readings, f, 1e-300, steps);
    });
  });
  const WorkCurve by_matrix{.family = WorkCurve::Family::matrix_gradients};
  attempt_all(section, by_matrix, [&] {
    const SkinMatrixGradients inverse(skin.problem(), input.alpha);
    add_steps(section, input, by_matrix, clock, [&](std::size_t steps, std::span<double> f) {
      return inverse.solve(input.readings, f, steps);
    });
  });
  return section;
}

}  // namespace tactile_net::study
