// tikhonov and closed_form by dense matrices: one product a frame where all weights are given.
#include "lab/methods/methods.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"

namespace tactile_net::lab {
namespace {

/// A matrix-vector product a frame.
class MatrixProduct final : public FrameSolver {
 public:
  MatrixProduct(Reconstruction inverse, double alpha, Condition::Matrix matrix)
      : inverse_(std::move(inverse)), alpha_(alpha), matrix_(matrix) {}

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    return {.status = inverse_.solve(readings, tractions),
            .alpha = ChosenAlpha{.value = alpha_},
            .condition = Condition{.value = inverse_.condition(), .matrix = matrix_}};
  }
  [[nodiscard]] std::optional<ChosenAlpha> alpha_of(const SceneFrame&) override {
    return ChosenAlpha{.value = alpha_};
  }
  [[nodiscard]] std::size_t tractions() const override { return inverse_.tractions(); }
  [[nodiscard]] const Reconstruction* product() const noexcept override { return &inverse_; }

 private:
  Reconstruction inverse_;
  double alpha_;
  Condition::Matrix matrix_;
};

/// What one alpha is for: a weight estimated frame by frame needs the frame too.
ChooseAlpha given(double alpha) {
  return [=](const SceneFrame&) { return ChosenAlpha{.value = alpha}; };
}

ChosenAlpha by_rule(const SceneFrame& frame) { return frame.alpha(); }

}  // namespace

std::unique_ptr<FrameSolver> make_tikhonov(const SceneProblem& problem,
                                           std::optional<double> alpha) {
  const bool is_plain = !problem.constraints() && !problem.estimates_weight();
  if (is_plain && problem.is_large()) return make_conjugate_gradients(problem, alpha);
  if (!alpha)
    return make_solver_of_frames(
        problem, Method::tikhonov,
        problem.chooses_on_active_set() ? ChooseAlpha(alpha_on_active_set) : by_rule);
  if (problem.estimates_weight())
    return make_solver_of_frames(problem, Method::tikhonov, given(*alpha));
  if (problem.constraints()) return make_active_set(problem, *alpha);
  return std::make_unique<MatrixProduct>(problem.tikhonov(*alpha), *alpha,
                                         Condition::Matrix::stacked);
}

std::unique_ptr<FrameSolver> make_closed_form(const SceneProblem& problem,
                                              std::optional<double> alpha) {
  if (!alpha) return make_solver_of_frames(problem, Method::closed_form, by_rule);
  if (problem.estimates_weight())
    return make_solver_of_frames(problem, Method::closed_form, given(*alpha));
  return std::make_unique<MatrixProduct>(
      closed_form(problem.problem(), *alpha, problem.known_condition(*alpha)), *alpha,
      Condition::Matrix::eliminated);
}

}  // namespace tactile_net::lab
