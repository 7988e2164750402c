// tikhonov where nothing pulls and friction has a limit.
#include <algorithm>
#include <cmath>

#include "lab/methods/methods.hpp"

namespace tactile_net::lab {
namespace {

class ActiveSet final : public FrameSolver {
 public:
  ActiveSet(const SceneProblem& problem, double alpha)
      : inverse_(problem.problem(), alpha, *problem.constraints()),
        tractions_(problem.tractions()),
        alpha_(alpha) {}

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (tractions.size() != tractions_) return {.status = FrameStatus::wrong_size};
    ConstrainedSolution solution = inverse_.solve(readings);
    if (solution.status != FrameStatus::ok) return {.status = solution.status};
    std::copy(solution.tractions.begin(), solution.tractions.end(), tractions.begin());
    FrameResult result{.alpha = ChosenAlpha{.value = alpha_},
                       .condition = Condition{solution.condition}};
    if (solution.verdict == ConstrainedVerdict::iteration_limit) {
      result.verdict = Verdict::iteration_limit;
      result.remarks.emplace_back(remark::IterationLimit{solution.iterations});
    }
    result.constrained = std::move(solution);
    return result;
  }
  [[nodiscard]] std::optional<ChosenAlpha> alpha_of(const SceneFrame&) override {
    return ChosenAlpha{.value = alpha_};
  }
  [[nodiscard]] std::size_t tractions() const override { return tractions_; }

 private:
  ConstrainedTikhonov inverse_;
  std::size_t tractions_;
  double alpha_;
};

}  // namespace

std::unique_ptr<FrameSolver> make_active_set(const SceneProblem& problem, double alpha) {
  return std::make_unique<ActiveSet>(problem, alpha);
}

ChosenAlpha alpha_on_active_set(const SceneFrame& frame) {
  constexpr int most_steps = 10;  // sets and alphas that take turns stay within a few per cent
  constexpr double agreed = 0.01;
  const SceneProblem& problem = frame.problem();
  const Constraints& constraints = *problem.constraints();
  ChosenAlpha alpha = frame.alpha();
  for (int step = 0; step < most_steps; ++step) {
    const ConstrainedSolution found =
        ConstrainedTikhonov(problem.problem(), alpha.value, constraints).solve(frame.readings());
    if (found.status != FrameStatus::ok || found.free.empty()) break;
    const TikhonovFamily family(problem.problem(),
                                active_face(problem.problem(), constraints, found.free));
    const AlphaChoice choice =
        choose_alone(family.analyse(frame.readings()), problem.alpha_rule(frame.analysed()),
                     problem.stated_noise());
    const double change = std::abs(std::log(choice.alpha / alpha.value));
    alpha = {.value = choice.alpha, .rule = choice.rule, .verdict = choice.verdict};
    if (change < agreed) break;
  }
  return alpha;
}

}  // namespace tactile_net::lab
