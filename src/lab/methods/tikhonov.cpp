// tikhonov and closed_form by dense matrices: one product a frame where alpha is given, the family
// of every alpha where a rule chooses it frame by frame.
#include "lab/methods/frame_check.hpp"
#include "lab/methods/methods.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

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
  [[nodiscard]] std::size_t tractions() const override { return inverse_.tractions(); }

 private:
  Reconstruction inverse_;
  double alpha_;
  Condition::Matrix matrix_;
};

/// Each frame gets the alpha that the scene's rule chooses; the family solves for it.
class FamilyOfFrames final : public FrameSolver {
 public:
  explicit FamilyOfFrames(const SceneProblem& problem) : problem_(problem) {
    (void)problem_.family();
  }

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (const auto status =
            check_frame(readings, problem_.readings(), tractions, problem_.tractions());
        status != FrameStatus::ok)
      return {.status = status};
    const SceneFrame frame(problem_, readings);
    const ChosenAlpha alpha = frame.alpha();
    const TikhonovFamily& family = problem_.family();
    return {.status = deliver(family.solve(frame.analysed(), alpha.value), tractions),
            .alpha = alpha,
            .verdict = verdict_of(alpha.verdict),
            .condition = Condition{family.stacked_condition(alpha.value), Condition::Kind::bound}};
  }
  [[nodiscard]] std::size_t tractions() const override { return problem_.tractions(); }

 private:
  SceneProblem problem_;
};

/// Each frame gets the alpha that the scene's rule chooses, and a solver made for it.
class SolverOfFrames final : public FrameSolver {
 public:
  using Make = std::unique_ptr<FrameSolver> (*)(const SceneProblem&, std::optional<double>);
  SolverOfFrames(const SceneProblem& problem, Make make) : problem_(problem), make_(make) {
    (void)problem_.family();
  }

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (const auto status =
            check_frame(readings, problem_.readings(), tractions, problem_.tractions());
        status != FrameStatus::ok)
      return {.status = status};
    const ChosenAlpha alpha = SceneFrame(problem_, readings).alpha();
    FrameResult result = make_(problem_, alpha.value)->solve(readings, tractions);
    result.alpha = alpha;
    if (alpha.verdict != AlphaVerdict::ok) result.verdict = verdict_of(alpha.verdict);
    return result;
  }
  [[nodiscard]] std::size_t tractions() const override { return problem_.tractions(); }

 private:
  SceneProblem problem_;
  Make make_;
};

}  // namespace

std::unique_ptr<FrameSolver> make_tikhonov(const SceneProblem& problem,
                                           std::optional<double> alpha) {
  if (problem.constraints()) {
    if (alpha) return make_active_set(problem, alpha);
    return std::make_unique<SolverOfFrames>(problem, make_active_set);
  }
  if (problem.is_large()) return make_conjugate_gradients(problem, alpha);
  if (alpha)
    return std::make_unique<MatrixProduct>(problem.tikhonov(*alpha), *alpha,
                                           Condition::Matrix::stacked);
  return std::make_unique<FamilyOfFrames>(problem);
}

std::unique_ptr<FrameSolver> make_closed_form(const SceneProblem& problem,
                                              std::optional<double> alpha) {
  if (alpha)
    return std::make_unique<MatrixProduct>(
        closed_form(problem.problem(), *alpha, problem.known_condition(*alpha)), *alpha,
        Condition::Matrix::eliminated);
  return std::make_unique<SolverOfFrames>(problem, make_closed_form);
}

}  // namespace tactile_net::lab
