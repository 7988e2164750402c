#include "study/points.hpp"

#include <algorithm>

#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::study {

Failure caught() {
  try {
    throw;
  } catch (const Failed& error) {
    return error.failure();
  } catch (const std::exception& error) {
    return {.kind = Failure::Kind::refused, .what = error.what()};
  }
}

std::vector<double> truth_of(const StudyInput& input) {
  std::vector<double> truth;
  for (const std::vector<double>& component : input.truth)
    truth.insert(truth.end(), component.begin(), component.end());
  truth.resize(input.solution.size());
  return truth;
}

std::optional<double> error_to_truth(const StudyInput& input, std::span<const double> f) {
  if (input.truth.empty() || input.solution.size() % input.truth.front().size() != 0)
    return std::nullopt;
  const std::vector<double> truth = truth_of(input);
  if (!(l2_norm(truth) > 0.0) || f.size() != truth.size()) return std::nullopt;
  return relative_l2_error(f, truth);
}

WorkPoint point(const StudyInput& input, WorkCurve curve, Knob knob, std::span<const double> f,
                const lab::Seconds& seconds) {
  WorkPoint result;
  result.curve = std::move(curve);
  result.knob = std::move(knob);
  result.seconds = seconds.median;
  result.seconds_low = seconds.low;
  result.seconds_high = seconds.high;
  result.error_to_solution = std::max(relative_l2_error(f, input.solution), input.resolution());
  result.error_to_truth = error_to_truth(input, f);
  return result;
}

WorkPoint failed(WorkCurve curve, Knob knob, TimeOf time_of, Failure failure) {
  WorkPoint result;
  result.curve = std::move(curve);
  result.knob = std::move(knob);
  result.time_of = time_of;
  result.failure = std::move(failure);
  return result;
}

void attempt(StudySection& section, const WorkCurve& curve, const Knob& knob,
             const std::function<WorkPoint()>& work) {
  try {
    section.points.push_back(work());
  } catch (const std::exception&) {
    section.points.push_back(failed(curve, knob, TimeOf::frame, caught()));
  }
}

}  // namespace tactile_net::study
