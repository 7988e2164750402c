#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "study/digital.hpp"
#include "study/points.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net::study {
namespace {

/// Adds the product that these options plan; equal ranks would be the same point again.
void add_product(StudySection& section, const StudyInput& input, PlannerOptions options,
                 const lab::Clock& clock) {
  options.diagnostics = false;
  const WorkCurve curve{.family = WorkCurve::Family::product,
                        .structure = options.structure,
                        .precision = options.precision};
  attempt(section, curve, {}, [&] {
    const PlannedEstimator planned = plan_estimator(input.problem.problem(), input.alpha, options);
    ContactEstimator estimator(planned.plan, fft_convolutions());
    std::vector<double> f(estimator.tractions());
    ContactEstimate estimate;
    estimate.tractions = f;
    const auto frame = [&] {
      if (estimator.update(input.readings, estimate) != FrameStatus::ok)
        throw Failed({.kind = Failure::Kind::no_frame});
    };
    const lab::Seconds seconds = lab::time_of(frame, 0.03, clock);
    Knob knob{.ranks = planned.candidates.front().ranks};
    if (!knob.ranks.empty()) knob.kind = Knob::Kind::ranks;
    return point(input, curve, std::move(knob), f, seconds);
  });
  auto& points = section.points;
  const auto same = [](const WorkPoint& a, const WorkPoint& b) {
    return a.measured() && b.measured() && a.curve == b.curve && a.knob == b.knob;
  };
  if (points.size() >= 2 && same(points.back(), points[points.size() - 2])) points.pop_back();
}

bool is_symmetric(const InverseProblem& problem) {
  return std::none_of(problem.weights.begin(), problem.weights.end(),
                      [](double weight) { return weight == 0.0; });
}

}  // namespace

StudySection products(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  using enum Structure;
  const bool symmetric = is_symmetric(input.problem.problem());
  const auto add = [&](Structure structure, Precision precision, double accuracy) {
    PlannerOptions options;
    options.accuracy = accuracy;
    options.structure = structure;
    options.precision = precision;
    add_product(section, input, options, clock);
  };
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    add(dense, precision, PlannerOptions{}.accuracy);
    if (symmetric) add(parity, precision, PlannerOptions{}.accuracy);
    for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.2) {
      if (precision == Precision::float32 && accuracy < 1e-7) break;
      add(symmetric ? parity_low_rank : low_rank, precision, accuracy);
    }
  }
  for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.1) {
    add(fft, Precision::float64, accuracy);
    if (!section.points.back().measured()) break;
  }
  return section;
}

}  // namespace tactile_net::study
