#include "tactile_net/lab/recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "lab/line_answer.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/methods/frame_check.hpp"

namespace tactile_net::lab {
namespace {

/// A frame's answer, without bands. Where it has none the status says why.
FrameResult answered_without_bands(const LineFrame& frame, std::span<double> tractions) {
  const SceneProblem& problem = frame.problem;
  if (const auto status =
          check_frame(frame.readings, problem.readings(), tractions, frame.solver->tractions());
      status != FrameStatus::ok)
    return {.status = status};
  try {
    LineFrameMethod method(frame);
    const FrameAnswer found = answer(method, Bands::later);
    std::copy(found.tractions.begin(), found.tractions.end(), tractions.begin());
    return method.result(found);
  } catch (const FrameOverflow&) {
    return {.status = FrameStatus::too_large};
  }
}

}  // namespace

RecordingSolver::RecordingSolver(SceneProblem problem, Method method,
                                 RecordingSolverOptions options)
    : problem_(std::move(problem)),
      method_(method),
      sites_(sites(problem_.scene().sensor)),
      missing_(options.missing),
      solver_(options.share_alpha ? make_sharing_solver(problem_, method, *options.share_alpha)
                                  : make_solver(problem_, method)),
      repeating_(problem_.scene().sensor, problem_.scene().dead_taxels),
      doubts_(problem_),
      checker_(problem_.scene()) {
  const SensorEffects& effects = problem_.scene();
  const bool may_clip = effects.saturation || effects.quantization;
  if (missing_ == Missing::estimate || (may_clip && can_leave_out(problem_, method)))
    incomplete_ = std::make_unique<IncompleteFrames>(problem_, method);
}

std::optional<FrameResult> RecordingSolver::solve(std::span<double> readings,
                                                  std::span<double> tractions,
                                                  std::optional<double> time) {
  repeating_.add(readings);
  checker_.add(time, readings);
  const bool misses =
      missing_ != Missing::fail &&
      std::any_of(readings.begin(), readings.end(), [](double g) { return std::isnan(g); });
  remark::Clipped clipped = clipped_in(problem_.scene(), sites_, readings);
  clipped.left_out = incomplete_ && clipped.range_known && !clipped.taxels.empty();
  const bool is_partial = clipped.left_out || (misses && missing_ == Missing::estimate);
  const std::optional<IncompleteFrames::Rest> rest =
      is_partial ? without(readings, clipped) : std::nullopt;
  if (misses && !rest) {
    solved_.skip();
    return std::nullopt;
  }
  clipped.left_out = clipped.left_out && rest;
  FrameResult result = answered_without_bands({.problem = rest ? rest->problem : problem_,
                                               .readings = readings,
                                               .solver = rest ? &rest->solver : solver_.get(),
                                               .has_bands = traits(method_).has_bands,
                                               .memory = rest ? nullptr : &memory_,
                                               .repeats = repeating_.first()},
                                              tractions);
  if (result.status != FrameStatus::ok) return result;
  note_clipped(result.verdict, result.remarks, std::move(clipped));
  was_incomplete_ = rest.has_value();
  solved_.add(result, misses);
  if (result.alpha) doubts_.add(problem(), readings, tractions, result.alpha->value);
  return result;
}

std::optional<IncompleteFrames::Rest> RecordingSolver::without(std::span<double> readings,
                                                               const remark::Clipped& clipped) {
  std::vector<double> rest(readings.begin(), readings.end());
  if (clipped.left_out)
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (std::binary_search(clipped.taxels.begin(), clipped.taxels.end(), sites_[i].taxel))
        rest[i] = std::numeric_limits<double>::quiet_NaN();
  const auto left = incomplete_->rest(rest);
  if (left) std::copy(rest.begin(), rest.end(), readings.begin());
  return left;
}

Findings RecordingSolver::doubts() const {
  Findings all = doubts_.findings();
  Findings over_time = checker_.doubts();
  std::move(over_time.begin(), over_time.end(), std::back_inserter(all));
  return all;
}

const SceneProblem& RecordingSolver::problem() const noexcept {
  return was_incomplete_ ? incomplete_->problem() : problem_;
}

}  // namespace tactile_net::lab
