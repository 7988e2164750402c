/// @file
/// Private. Makes the points of a study's sections.
#pragma once

#include <exception>
#include <functional>
#include <span>
#include <stdexcept>
#include <utility>

#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::study {

/// A failure on its way to the point that it is written into.
class Failed : public std::exception {
 public:
  explicit Failed(Failure failure) : failure_(std::move(failure)) {}
  [[nodiscard]] const Failure& failure() const noexcept { return failure_; }

 private:
  Failure failure_;
};

/// What was caught, as a failure. @pre called in a handler
[[nodiscard]] Failure caught();

/// The truth in the order of the tractions that are solved for.
[[nodiscard]] std::vector<double> truth_of(const StudyInput& input);

/// |f - truth|_2 / |truth|_2; absent: there is no truth, or f is of another size.
[[nodiscard]] std::optional<double> error_to_truth(const StudyInput& input,
                                                   std::span<const double> f);

/// A timed point of the problem that all share: both of its errors are known.
[[nodiscard]] WorkPoint point(const StudyInput& input, WorkCurve curve, Knob knob,
                              std::span<const double> f, const lab::Seconds& seconds);

[[nodiscard]] WorkPoint failed(WorkCurve curve, Knob knob, TimeOf time_of, Failure failure);

/// Adds the point that `work` returns; a method that refuses the scene is a point that says so.
void attempt(StudySection& section, const WorkCurve& curve, const Knob& knob,
             const std::function<WorkPoint()>& work);

}  // namespace tactile_net::study
