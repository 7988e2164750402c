#include <vector>

#include "study/digital.hpp"
#include "study/kronecker_sum.hpp"
#include "study/points.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net::study {
namespace {

/// A QR of every frame that takes more additions than this takes seconds, and is left out.
constexpr double most_additions = 5e8;

double additions_of_qr(const LinearProblem& problem) {
  const auto rows = static_cast<double>(problem.kernel.rows);
  const auto columns = static_cast<double>(problem.kernel.columns);
  const double least = std::min(rows, columns);
  return (rows + columns) * least * least;
}

}  // namespace

StudySection skin_factorisations(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const LinearProblem& problem = input.skin().problem();
  const WorkCurve every_alpha{.family = WorkCurve::Family::singular_values};
  attempt(section, every_alpha, {}, [&] {
    const TikhonovFamily& family = input.skin().family();
    std::vector<double> f;
    const lab::Seconds seconds = lab::time_of(
        [&] { f = family.solve(family.analyse(input.readings), input.alpha); }, 0.03, clock);
    return point(input, every_alpha, {}, f, seconds);
  });
  if (additions_of_qr(problem) > most_additions) return section;
  const WorkCurve every_frame{.family = WorkCurve::Family::factorisation};
  attempt(section, every_frame, {}, [&] {
    std::vector<double> f;
    const lab::Seconds seconds = lab::time_of(
        [&] { f = tikhonov_solve(problem, input.alpha, input.readings); }, 0.03, clock);
    return point(input, every_frame, {}, f, seconds);
  });
  return section;
}

StudySection kronecker_sums(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::kronecker};
  try {
    const lab::SkinSceneProblem& skin = input.skin();
    const KroneckerTerms terms(skin.problem(), skin.family().reconstruction(input.alpha));
    std::size_t before = 0;
    for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.2) {
      KroneckerSum sum = terms.sum(accuracy);
      if (sum.terms() == before) continue;
      before = sum.terms();
      std::vector<double> f(input.solution.size());
      const lab::Seconds seconds = lab::time_of([&] { sum.apply(input.readings, f); }, 0.03, clock);
      section.points.push_back(
          point(input, curve, {.kind = Knob::Kind::terms, .count = sum.terms()}, f, seconds));
    }
  } catch (const std::exception&) {
    section.points.push_back(failed(curve, {}, TimeOf::frame, caught()));
  }
  return section;
}

}  // namespace tactile_net::study
