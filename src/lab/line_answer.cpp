#include "lab/line_answer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "lab/border.hpp"
#include "lab/lines_and_skins.hpp"
#include "tactile_net/inverse/error_bound.hpp"

namespace tactile_net::lab {

const SceneFrame& LineFrameMethod::analysed() const {
  if (frame_.analysed != nullptr) return *frame_.analysed;
  if (!own_) own_.emplace(frame_.problem, frame_.readings);
  return *own_;
}

ChosenAlpha LineFrameMethod::alpha() {
  if (frame_.known != nullptr) return *frame_.known->alpha;
  if (!frame_.has_bands) return {};
  ChosenAlpha alpha = frame_.alpha ? *frame_.alpha : *frame_.solver->alpha_of(analysed());
  alpha.tangential_weight = analysed().estimated_weight();
  return alpha;
}

void LineFrameMethod::solve(FrameAnswer& answer) {
  if (frame_.known != nullptr) {
    answer.tractions.assign(frame_.found.begin(), frame_.found.end());
    result_ = *frame_.known;
    answer.verdict = result_.solved.value_or(result_.verdict);
    std::erase_if(result_.remarks, [](const Remark& one) {  // which are said anew
      return std::holds_alternative<remark::LowerBound>(one) ||
             std::holds_alternative<remark::Clipped>(one);
    });
  } else {
    std::vector<double> f(frame_.solver->tractions());
    result_ = frame_.has_bands ? frame_.solver->solve_by(analysed(), answer.alpha, f)
                               : frame_.solver->solve(frame_.readings, f);
    if (result_.status == FrameStatus::too_large) throw FrameOverflow();
    if (result_.status != FrameStatus::ok) throw std::domain_error("the readings are not finite");
    answer.tractions = std::move(f);
    if (result_.verdict != Verdict::ok) answer.verdict = result_.verdict;
    result_.solved = answer.verdict;
    if (frame_.has_bands) result_.alpha = answer.alpha;
  }
  answer.condition = result_.condition;
  answer.constrained = result_.constrained;
  answer.remarks = result_.remarks;
}

FrameResult LineFrameMethod::result(const FrameAnswer& answer) const {
  FrameResult all = result_;
  all.verdict = answer.verdict;
  all.remarks = answer.remarks;
  all.data = answer.data;
  return all;
}

std::optional<double> LineFrameMethod::rounding(const FrameAnswer& answer) const {
  if (!answer.condition)
    return frame_.solver != nullptr ? frame_.solver->error_bound(frame_.readings, answer.tractions)
                                    : std::nullopt;
  const SceneProblem& problem = analysed().problem();
  double bound = forward_bound(problem.problem(), answer.alpha.value, frame_.readings,
                               answer.tractions, answer.condition->value);
  // Under a friction limit f = E z, and E has the condition number max(limit, 1 / limit).
  const auto limit = problem.scene().reconstruct.friction_limit;
  if (answer.constrained && limit) bound *= std::max(*limit, 1.0 / *limit);
  return bound;
}

bool LineFrameMethod::ends_at_border(std::span<const double> tractions) const {
  const SceneProblem& problem = frame_.problem;
  return frame_.has_bands &&
         presses_at_border(tractions.first(problem.surface().count), problem.border());
}

std::optional<DataVerdict> LineFrameMethod::judge_data(std::span<const double> tractions) const {
  if (frame_.known != nullptr) return frame_.known->data;
  if (frame_.problem.is_large()) return std::nullopt;
  return frame_.problem.data_judge().judge(frame_.readings, tractions, frame_.memory);
}

std::optional<std::vector<double>> LineFrameMethod::unconstrained(double) const {
  if (!frame_.problem.constraints()) return std::nullopt;
  const SceneFrame& frame = analysed();
  return frame.problem().family().solve(frame.analysed(), frame.prior().alpha);
}

Uncertain LineFrameMethod::add_bands(FrameAnswer& answer) {
  FrameUncertainty bands = uncertainty(analysed(), answer.tractions, result_);
  answer.noise = bands.noise;
  answer.offsets = bands.offsets;
  answer.deviations = bands.deviation;
  answer.bands = std::move(bands);
  return answer.bands->resultant.normal;
}

remark::OffsetsFound LineFrameMethod::named(std::span<const double> offsets) const {
  return offsets_found(offsets, frame_.problem.scene());
}

remark::DataDoubted LineFrameMethod::named(const DataVerdict& data) const {
  return with_names(data, frame_.problem.scene());
}

FrameAnswer with_bands(const SceneFrame& frame, std::span<const double> tractions,
                       const FrameResult& result) {
  LineFrameMethod solved({.problem = frame.given(),
                          .readings = frame.readings(),
                          .analysed = &frame,
                          .known = &result,
                          .found = tractions});
  FrameAnswer found = answer(solved);
  for (const Remark& one : result.remarks)
    if (const auto* clipped = std::get_if<remark::Clipped>(&one))
      note_clipped(found.verdict, found.remarks, *clipped);
  return found;
}

}  // namespace tactile_net::lab
