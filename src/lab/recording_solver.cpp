#include "tactile_net/lab/recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tactile_net/lab/data_verdict.hpp"

namespace tactile_net::lab {

RecordingSolver::RecordingSolver(SceneProblem problem, Method method,
                                 RecordingSolverOptions options)
    : problem_(std::move(problem)),
      missing_(options.missing),
      solver_(options.share_alpha ? make_sharing_solver(problem_, method, *options.share_alpha)
                                  : make_solver(problem_, method)),
      repeating_(problem_.scene().sensor, problem_.scene().dead_taxels),
      doubts_(problem_) {
  if (missing_ == Missing::estimate)
    incomplete_ = std::make_unique<IncompleteFrames>(problem_, method);
}

std::optional<FrameResult> RecordingSolver::solve(std::span<double> readings,
                                                  std::span<double> tractions) {
  repeating_.add(readings);
  const bool incomplete =
      missing_ != Missing::fail &&
      std::any_of(readings.begin(), readings.end(), [](double g) { return std::isnan(g); });
  std::optional<FrameResult> result;
  if (!incomplete)
    result = solver_->solve(readings, tractions);
  else if (incomplete_)
    result = incomplete_->solve(readings, tractions);
  if (!result) {
    solved_.skip();
    return result;
  }
  if (result->status != FrameStatus::ok) return result;

  was_incomplete_ = incomplete;
  result->data =
      data_verdict(this->problem(), readings, tractions, incomplete ? nullptr : &memory_);
  if (result->data) doubt(*result->data, repeating_.first());
  solved_.add(*result, incomplete);
  if (result->alpha) doubts_.add(this->problem(), readings, tractions, result->alpha->value);
  return result;
}

const SceneProblem& RecordingSolver::problem() const noexcept {
  return was_incomplete_ ? incomplete_->problem() : problem_;
}

}  // namespace tactile_net::lab
