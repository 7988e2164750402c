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
    ChosenAlpha alpha{.value = given_.value_or(0.0)};
    if (!given_) {
      if (const auto status =
              check_frame(readings, problem_.readings(), tractions, problem_.tractions());
          status != FrameStatus::ok)
        return {.status = status};
      alpha = SceneFrame(problem_, readings).alpha();
      inverse_.use_alpha(alpha.value);
    }
    FrameResult result{.status = inverse_.solve(readings, tractions), .alpha = alpha};
    const Convergence& convergence = inverse_.convergence();
    if (!convergence.converged) {
      result.verdict = Verdict::not_converged;
      result.remarks.emplace_back(remark::NotConverged{convergence.steps, convergence.estimate});
    }
    if (alpha.verdict != AlphaVerdict::ok) result.verdict = verdict_of(alpha.verdict);
    return result;
  }
  [[nodiscard]] std::size_t tractions() const override { return inverse_.tractions(); }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double>,
                                                  std::span<const double>) override {
    return inverse_.convergence().bound;
  }

 private:
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
