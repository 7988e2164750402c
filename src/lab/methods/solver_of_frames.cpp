// An alpha for each frame, whoever chooses it.
#include <utility>

#include "lab/methods/frame_check.hpp"
#include "lab/methods/methods.hpp"

namespace tactile_net::lab {
namespace {

class SolverOfFrames final : public FrameSolver {
 public:
  SolverOfFrames(const SceneProblem& problem, Method method, ChooseAlpha choose)
      : problem_(problem), method_(method), choose_(std::move(choose)) {
    if (!problem_.is_large()) (void)problem_.family();
  }

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (const auto status =
            check_frame(readings, problem_.readings(), tractions, problem_.tractions());
        status != FrameStatus::ok)
      return {.status = status};
    const SceneFrame frame(problem_, readings);
    const ChosenAlpha alpha = *alpha_of(frame);
    FrameResult result = solve_by(frame, alpha, tractions);
    result.alpha = alpha;
    if (result.verdict == Verdict::ok) result.verdict = verdict_of(alpha.verdict);
    return result;
  }
  [[nodiscard]] std::optional<ChosenAlpha> alpha_of(const SceneFrame& frame) override {
    ChosenAlpha alpha = choose_(frame);
    alpha.tangential_weight = frame.estimated_weight();
    return alpha;
  }
  /// The family has every alpha's answer; what has none is made for it.
  [[nodiscard]] FrameResult solve_by(const SceneFrame& frame, const ChosenAlpha& alpha,
                                     std::span<double> tractions) override {
    const SceneProblem& problem = frame.problem();
    if (method_ != Method::tikhonov || problem.constraints() || problem.is_large())
      return make_solver(problem, method_, alpha.value)->solve(frame.readings(), tractions);
    const TikhonovFamily& family = problem.family();
    return {.status = deliver(family.solve(frame.analysed(), alpha.value), tractions),
            .condition = Condition{family.stacked_condition(alpha.value), Condition::Kind::bound}};
  }
  [[nodiscard]] std::size_t tractions() const override { return problem_.tractions(); }

 private:
  SceneProblem problem_;
  Method method_;
  ChooseAlpha choose_;
};

}  // namespace

std::unique_ptr<FrameSolver> make_solver_of_frames(const SceneProblem& problem, Method method,
                                                   ChooseAlpha choose) {
  return std::make_unique<SolverOfFrames>(problem, method, std::move(choose));
}

}  // namespace tactile_net::lab
