#include "lab/skin_method.hpp"

#include "lab/large_skin.hpp"
#include "lab/skin_data_verdict.hpp"
#include "tactile_net/inverse/covariance.hpp"

namespace tactile_net::lab {
namespace {

/// By all singular values.
class DenseMethod final : public SkinMethod {
 public:
  explicit DenseMethod(const SkinSceneProblem& problem) : problem_(problem) {}

  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const override {
    return problem_.family().analyse(readings);
  }
  [[nodiscard]] double condition(double alpha) const override {
    return problem_.family().condition(alpha);
  }
  [[nodiscard]] double stacked_condition(double alpha) const override {
    return problem_.family().stacked_condition(alpha);
  }
  [[nodiscard]] double degrees_of_freedom(double alpha) const override {
    return problem_.family().degrees_of_freedom(alpha);
  }
  [[nodiscard]] std::vector<double> solve(const FilterFrame& frame, std::span<const double>,
                                          double alpha) const override {
    return problem_.family().solve(frame, alpha);
  }
  [[nodiscard]] ConeSolution solve_in_cones(std::span<const double> readings,
                                            double alpha) const override {
    return problem_.cone(alpha)->solve(readings);
  }
  [[nodiscard]] std::unique_ptr<const CellCovariance> covariance(
      double alpha, double prior_alpha) const override {
    return std::make_unique<TractionCovariance>(problem_.family(), alpha, prior_alpha);
  }
  [[nodiscard]] double residual(std::span<const double> readings,
                                std::span<const double> tractions) const override {
    return residual_norm(problem_.problem(), readings, tractions);
  }
  [[nodiscard]] DataVerdict judge(std::span<const double> readings,
                                  std::span<const double> tractions) const override {
    return problem_.data_judge().judge(without_offsets(problem_, readings, tractions), tractions);
  }

 private:
  const SkinSceneProblem& problem_;
};

/// By products, of which the problem keeps what frames share.
class LargeMethod final : public SkinMethod {
 public:
  explicit LargeMethod(const SkinSceneProblem& problem)
      : large_(problem.large()), constraints_(problem.constraints()) {}

  FilterFrame analyse(std::span<const double> readings) const override {
    return large_.family().analyse(readings);
  }
  double condition(double alpha) const override { return large_.family().condition(alpha); }
  double stacked_condition(double alpha) const override {
    return large_.family().stacked_condition(alpha);
  }
  double degrees_of_freedom(double alpha) const override {
    return large_.family().degrees_of_freedom(alpha);
  }
  std::vector<double> solve(const FilterFrame&, std::span<const double> readings,
                            double alpha) const override {
    std::vector<double> tractions = large_.solve(readings, alpha);
    convergence_ = large_.solver(alpha).convergence();
    return tractions;
  }
  ConeSolution solve_in_cones(std::span<const double> readings, double alpha) const override {
    return large_.solve_in_cones(readings, alpha, *constraints_);
  }
  std::unique_ptr<const CellCovariance> covariance(double alpha,
                                                   double prior_alpha) const override {
    return large_.covariance(alpha, prior_alpha);
  }
  std::optional<BandError> band_error(const Covariance& covariance) const override {
    return static_cast<const LargeSkinCovariance&>(covariance).error();
  }
  double residual(std::span<const double> readings,
                  std::span<const double> tractions) const override {
    return large_.residual(readings, tractions);
  }
  DataVerdict judge(std::span<const double> readings,
                    std::span<const double> tractions) const override {
    return large_.judge(readings, tractions);
  }
  std::optional<SkinConvergence> convergence() const override { return convergence_; }

 private:
  LargeSkin& large_;
  const std::optional<Constraints>& constraints_;
  mutable std::optional<SkinConvergence> convergence_{};
};

}  // namespace

std::unique_ptr<const SkinMethod> method_of(const SkinSceneProblem& problem) {
  if (problem.is_large()) return std::make_unique<LargeMethod>(problem);
  return std::make_unique<DenseMethod>(problem);
}

}  // namespace tactile_net::lab
