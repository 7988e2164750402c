// tikhonov for many tractions: conjugate gradients, with products by FFT.
#include "lab/methods/frame_check.hpp"
#include "lab/methods/methods.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"

namespace tactile_net::lab {
namespace {

class ConjugateGradients final : public FrameSolver {
 public:
  /// @param alpha  absent: each frame's is chosen by the scene's rule
  ConjugateGradients(const SceneProblem& problem, std::optional<double> alpha)
      : problem_(problem),
        given_(alpha),
        inverse_(problem.scene().sensor, problem.scene().material, problem.options(),
                 alpha.value_or(1.0)) {
    if (!given_) (void)problem_.sections();
  }

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (given_) return solve_with(readings, {.value = *given_}, tractions);
    if (const auto status =
            check_frame(readings, problem_.readings(), tractions, problem_.tractions());
        status != FrameStatus::ok)
      return {.status = status};
    const ChosenAlpha alpha = SceneFrame(problem_, readings).alpha();
    FrameResult result = solve_with(readings, alpha, tractions);
    if (result.verdict == Verdict::ok) result.verdict = verdict_of(alpha.verdict);
    return result;
  }
  [[nodiscard]] std::optional<ChosenAlpha> alpha_of(const SceneFrame& frame) override {
    return given_ ? ChosenAlpha{.value = *given_} : frame.alpha();
  }
  [[nodiscard]] FrameResult solve_by(const SceneFrame& frame, const ChosenAlpha& alpha,
                                     std::span<double> tractions) override {
    return solve_with(frame.readings(), alpha, tractions);
  }
  [[nodiscard]] std::size_t tractions() const override { return inverse_.tractions(); }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double>,
                                                  std::span<const double>) override {
    return inverse_.convergence().bound;
  }

 private:
  FrameResult solve_with(std::span<const double> readings, const ChosenAlpha& alpha,
                         std::span<double> tractions) {
    if (!given_) inverse_.use_alpha(alpha.value);
    FrameResult result{.status = inverse_.solve(readings, tractions), .alpha = alpha};
    const Convergence& convergence = inverse_.convergence();
    if (!convergence.converged) {
      result.verdict = Verdict::not_converged;
      result.remarks.emplace_back(remark::NotConverged{convergence.steps, convergence.estimate});
    }
    return result;
  }

  SceneProblem problem_;
  std::optional<double> given_;
  FftTikhonov inverse_;
};

}  // namespace

std::unique_ptr<FrameSolver> make_conjugate_gradients(const SceneProblem& problem,
                                                      std::optional<double> alpha) {
  return std::make_unique<ConjugateGradients>(problem, alpha);
}

}  // namespace tactile_net::lab
