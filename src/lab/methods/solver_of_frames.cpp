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
    const ChosenAlpha alpha = choose_(frame);
    FrameResult result = solve(frame, alpha.value, tractions);
    result.alpha = alpha;
    result.alpha->tangential_weight = frame.estimated_weight();
    if (alpha.verdict != AlphaVerdict::ok) result.verdict = verdict_of(alpha.verdict);
    return result;
  }
  [[nodiscard]] std::size_t tractions() const override { return problem_.tractions(); }

 private:
  /// The family has every alpha's answer; what has none is made for it.
  FrameResult solve(const SceneFrame& frame, double alpha, std::span<double> tractions) const {
    const SceneProblem& problem = frame.problem();
    if (method_ != Method::tikhonov || problem.constraints() || problem.is_large())
      return make_solver(problem, method_, alpha)->solve(frame.readings(), tractions);
    const TikhonovFamily& family = problem.family();
    return {.status = deliver(family.solve(frame.analysed(), alpha), tractions),
            .condition = Condition{family.stacked_condition(alpha), Condition::Kind::bound}};
  }

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
