#include "lab/line_answer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "lab/border.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/own_tractions.hpp"
#include "lab/recording_method.hpp"
#include "numeric/finite.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/lab/missing.hpp"

namespace tactile_net::lab {
const SceneFrame& LineFrameMethod::analysed() const {
  if (frame_.analysed != nullptr) return *frame_.analysed;
  if (!own_) own_.emplace(frame_.problem, frame_.readings);
  return *own_;
}

ChosenAlpha LineFrameMethod::alpha() {
  if (frame_.known != nullptr) return frame_.known->alpha;
  if (!frame_.has_bands) return {};
  ChosenAlpha alpha = frame_.alpha ? *frame_.alpha : *frame_.solver->alpha_of(analysed());
  alpha.tangential_weight = analysed().estimated_weight();
  return alpha;
}

void LineFrameMethod::solve(FrameAnswer& answer) {
  if (frame_.known != nullptr) {
    const FrameAnswer& known = *frame_.known;
    answer.tractions = known.tractions;
    answer.verdict = known.solved;
    result_ = {.alpha = known.alpha,
               .condition = known.condition,
               .remarks = known.remarks,
               .constrained = known.constrained,
               .by_mixture = known.mixture != nullptr};
    std::erase_if(result_.remarks, [](const Remark& one) {  // which are said anew
      return std::holds_alternative<remark::LowerBound>(one) ||
             std::holds_alternative<remark::Clipped>(one);
    });
  } else if (frame_.takes_mixture && frame_.problem.answers_by_mixture() &&
             !frame_.problem.constraints()) {
    result_ = {.alpha = answer.alpha, .by_mixture = true};
    answer.tractions = OwnTractions(frame_.problem).of(analysed().mixture()->mean());
    answer.verdict = Verdict::ok;  // alpha's is not of it
    if (!all_finite(answer.tractions)) throw FrameOverflow();
  } else {
    std::vector<double> f(frame_.solver->tractions());
    result_ = frame_.has_bands ? frame_.solver->solve_by(analysed(), answer.alpha, f)
                               : frame_.solver->solve(frame_.readings, f);
    if (result_.status == FrameStatus::too_large) throw FrameOverflow();
    if (result_.status != FrameStatus::ok) throw std::domain_error("the readings are not finite");
    answer.tractions = std::move(f);
    if (result_.verdict != Verdict::ok) answer.verdict = result_.verdict;
    if (frame_.has_bands)
      result_.alpha = answer.alpha;
    else if (result_.alpha)
      answer.alpha = *result_.alpha;
    result_.by_mixture = frame_.has_bands && frame_.takes_mixture && result_.constrained &&
                         frame_.problem.answers_by_mixture();
  }
  if (result_.by_mixture) answer.mixture = analysed().mixture();
  answer.solved = answer.verdict;
  answer.condition = result_.condition;
  answer.constrained = result_.constrained;
  answer.remarks = result_.remarks;
}

double LineFrameMethod::residual(std::span<const double> tractions) const {
  const SceneProblem& of_mixture = frame_.problem.of_mixture();
  if (!is_mean() || &of_mixture == &frame_.problem)
    return frame_.problem.residual(frame_.readings, tractions);
  // What presses between the taxels and beyond them explains readings, too.
  return of_mixture.residual(frame_.readings, analysed().mixture()->mean());
}

std::optional<double> LineFrameMethod::rounding(const FrameAnswer& answer) const {
  if (is_mean()) return std::nullopt;
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
  answer.low = bands.low;
  answer.high = bands.high;
  answer.bands = std::move(bands);
  return answer.bands->resultant.normal;
}

remark::OffsetsFound LineFrameMethod::named(std::span<const double> offsets) const {
  return offsets_found(offsets, frame_.problem.scene());
}

remark::DataDoubted LineFrameMethod::named(const DataVerdict& data) const {
  return with_names(data, frame_.problem.scene());
}

FrameAnswer solve(const SceneProblem& problem, std::span<const double> readings,
                  FrameSolver* solver) {
  const auto as_read = [&](const SceneProblem& of_frame, FrameSolver* made) {
    const auto own = made == nullptr ? make_solver(of_frame, Method::tikhonov) : nullptr;
    LineFrameMethod frame(
        {.problem = of_frame, .readings = readings, .solver = made == nullptr ? own.get() : made});
    return answer(frame);
  };
  const Scene& scene = problem.scene();
  const std::vector<Site> all = sites(scene.sensor);
  if (readings.size() != all.size()) return as_read(problem, solver);  // which refuses them
  return answer_without_clipped(
      scene, all, readings,
      [&](const std::vector<std::size_t>& dead) {
        return can_leave_out(problem, Method::tikhonov) && measures_without(problem, dead);
      },
      [&](const std::vector<std::size_t>* dead) {
        return dead != nullptr ? as_read(problem.without(*dead), nullptr)
                               : as_read(problem, solver);
      });
}

namespace {

FrameAnswer line_with_bands(const SceneProblem& problem, std::span<const double> readings,
                            const FrameAnswer& answered) {
  const SceneFrame frame(problem, readings, answered.mixture);
  LineFrameMethod solved(
      {.problem = problem, .readings = readings, .analysed = &frame, .known = &answered});
  FrameAnswer found = answer(solved);
  if (problem.constraints() && !found.constrained)
    note_ignored_constraints(found.verdict, found.remarks);
  for (const Remark& one : answered.remarks)
    if (const auto* clipped = std::get_if<remark::Clipped>(&one))
      note_clipped(found.verdict, found.remarks, *clipped);
  return found;
}

class LineRecordingMethod final : public RecordingMethod {
 public:
  LineRecordingMethod(const SceneProblem& problem, Method method,
                      std::unique_ptr<FrameSolver> solver)
      : RecordingMethod(problem), line_(problem), method_(method), solver_(std::move(solver)) {}

  /// Frames share an alpha: they are answered by it.
  void share() { shares_ = true; }

  /// Knows what earlier frames showed of contacts.
  void remember() { memory_.emplace(); }

  [[nodiscard]] std::size_t tractions() const override { return solver_->tractions(); }
  [[nodiscard]] Remarks remarks() const override { return solver_->remarks(); }
  [[nodiscard]] std::size_t bytes() const override { return bytes_of_frames(line_); }
  [[nodiscard]] bool takes_threads() const override { return false; }
  [[nodiscard]] std::shared_ptr<RecordingMethod> without(
      std::span<const std::size_t> taxels) const override {
    const SceneProblem rest = line_.without(taxels);
    auto other = std::make_shared<LineRecordingMethod>(rest, method_, make_solver(rest, method_));
    if (shares_) other->share();
    return other;
  }
  FrameAnswer answer(std::span<const double> readings,
                     std::optional<std::size_t> repeats) override {
    if (readings.size() != line_.readings() || !all_finite(readings))
      throw std::invalid_argument("a frame's readings have the wrong size or are not finite");
    LineFrameMethod frame({.problem = line_,
                           .readings = readings,
                           .solver = solver_.get(),
                           .has_bands = traits(method_).has_bands,
                           .takes_mixture = method_ == Method::tikhonov && !shares_,
                           .memory = memory_ ? &*memory_ : nullptr,
                           .repeats = repeats});
    FrameAnswer found = lab::answer(frame, Bands::later);
    if (line_.constraints() && !found.constrained)
      note_ignored_constraints(found.verdict, found.remarks);
    return found;
  }

 private:
  SceneProblem line_;
  Method method_;
  std::unique_ptr<FrameSolver> solver_;
  std::optional<DataMemory> memory_{};
  bool shares_ = false;
};

}  // namespace

std::shared_ptr<RecordingMethod> recording_method(const SceneProblem& problem, Method method,
                                                  std::optional<std::size_t> share_alpha) {
  auto made = std::make_shared<LineRecordingMethod>(
      problem, method,
      share_alpha ? make_sharing_solver(problem, method, *share_alpha)
                  : make_solver(problem, method));
  made->remember();
  if (share_alpha) made->share();
  return made;
}

bool has_bands(const AnyProblem& problem, Method method) {
  const auto* line = std::get_if<SceneProblem>(&problem);
  return line == nullptr || (traits(method).has_bands && line->has_bands());
}

FrameAnswer with_bands(const AnyProblem& problem, std::span<const double> readings,
                       FrameAnswer answer) {
  const auto* line = std::get_if<SceneProblem>(&problem);
  if (line == nullptr) return answer;
  return line_with_bands(*line, readings, answer);
}

}  // namespace tactile_net::lab
