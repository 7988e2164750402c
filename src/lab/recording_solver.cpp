#include "tactile_net/lab/recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "lab/border.hpp"
#include "lab/lines_and_skins.hpp"
#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/scene/clipped_taxels.hpp"

namespace tactile_net::lab {

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
  const ClippedTaxels clipped = clipped_taxels(problem_.scene(), sites_, readings);
  bool left_out = incomplete_ && clipped.range_known && !clipped.taxels.empty();
  std::optional<FrameResult> result;
  if (misses && missing_ == Missing::skip) {
    solved_.skip();
    return result;
  }
  if (misses || left_out) {
    std::vector<double> rest(readings.begin(), readings.end());
    if (left_out)
      for (std::size_t i = 0; i < rest.size(); ++i)
        if (std::binary_search(clipped.taxels.begin(), clipped.taxels.end(), sites_[i].taxel))
          rest[i] = std::numeric_limits<double>::quiet_NaN();
    result = incomplete_->solve(rest, tractions);
    if (result || misses) std::copy(rest.begin(), rest.end(), readings.begin());
    left_out = left_out && result;
  }
  if (!result && !misses) result = solver_->solve(readings, tractions);
  if (!result) {
    solved_.skip();
    return result;
  }
  if (result->status != FrameStatus::ok) return result;

  if (traits(method_).has_bands && result->verdict == Verdict::ok &&
      is_cut_off(this->problem(), readings, tractions)) {
    result->verdict = Verdict::cut_off;
    result->remarks.emplace_back(remark::LowerBound{});
  }
  if (!clipped.taxels.empty()) {
    result->verdict = Verdict::clipped;
    result->remarks.emplace_back(
        remark::Clipped{.taxels = clipped.taxels,
                        .names = taxel_names(this->problem().scene().sensor, clipped.taxels),
                        .range_known = clipped.range_known,
                        .left_out = left_out});
  }
  const bool incomplete = misses || left_out;
  was_incomplete_ = incomplete;
  result->data =
      data_verdict(this->problem(), readings, tractions, incomplete ? nullptr : &memory_);
  if (result->data) doubt(*result->data, repeating_.first());
  result->verdict = overall(result->verdict, result->data);
  solved_.add(*result, misses);
  if (result->alpha) doubts_.add(this->problem(), readings, tractions, result->alpha->value);
  return result;
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
