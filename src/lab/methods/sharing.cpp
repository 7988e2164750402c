// An alpha that neighbouring frames of a recording share.
#include <stdexcept>
#include <utility>

#include "lab/methods/frame_check.hpp"
#include "tactile_net/inverse/shared_alpha.hpp"
#include "tactile_net/lab/method.hpp"

namespace tactile_net::lab {
namespace {

class SharingFrames final : public FrameSolver {
 public:
  SharingFrames(SceneProblem problem, Method method, std::size_t frames)
      : problem_(std::move(problem)), method_(method), frames_(frames) {}

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (const auto status =
            check_frame(readings, problem_.readings(), tractions, problem_.tractions());
        status != FrameStatus::ok)
      return {.status = status};
    const SceneFrame frame(problem_, readings);
    const FilterFrame& analysed = frame.analysed();
    if (!shared_)
      shared_.emplace(AlphaTables(analysed.gamma, analysed.rows, analysed.shares),
                      problem_.alpha_rule(analysed), frames_, problem_.stated_noise());
    const AlphaChoice choice = shared_->push(analysed);
    const ChosenAlpha alpha{.value = choice.alpha, .rule = choice.rule, .verdict = choice.verdict};
    FrameResult result = solve(frame, readings, alpha.value, tractions);
    result.alpha = alpha;
    if (alpha.verdict != AlphaVerdict::ok) result.verdict = verdict_of(alpha.verdict);
    return result;
  }
  [[nodiscard]] std::size_t tractions() const override { return problem_.tractions(); }

 private:
  FrameResult solve(const SceneFrame& frame, std::span<const double> readings, double alpha,
                    std::span<double> tractions) {
    if (method_ != Method::tikhonov || problem_.constraints() || problem_.is_large())
      return make_solver(problem_, method_, alpha)->solve(readings, tractions);
    const TikhonovFamily& family = problem_.family();
    return {.status = deliver(family.solve(frame.analysed(), alpha), tractions),
            .condition = Condition{family.stacked_condition(alpha), Condition::Kind::bound}};
  }

  SceneProblem problem_;
  Method method_;
  std::size_t frames_;
  std::optional<SharedAlpha> shared_;  // made of the first frame
};

}  // namespace

std::unique_ptr<FrameSolver> make_sharing_solver(const SceneProblem& problem, Method method,
                                                 std::size_t frames) {
  if (!traits(method).has_bands || problem.scene().reconstruct.alpha)
    throw std::invalid_argument(
        "frames share an alpha that a rule chooses for tikhonov or closed_form: this scene gives "
        "one, or the method is another");
  return std::make_unique<SharingFrames>(problem, method, frames);
}

}  // namespace tactile_net::lab
