/// @file
/// What an answer asks of a skin's solver, whatever the skin's size: one with all of its matrix, or
/// one by products. Private.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/skin/large/covariance.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net::lab {

class SkinMethod {
 public:
  SkinMethod() = default;
  SkinMethod(const SkinMethod&) = delete;
  SkinMethod& operator=(const SkinMethod&) = delete;
  virtual ~SkinMethod() = default;

  [[nodiscard]] virtual FilterFrame analyse(std::span<const double> readings) const = 0;
  /// As `TikhonovFamily`'s.
  [[nodiscard]] virtual double condition(double alpha) const = 0;
  [[nodiscard]] virtual double stacked_condition(double alpha) const = 0;
  [[nodiscard]] virtual double degrees_of_freedom(double alpha) const = 0;
  /// @param frame  of these readings
  [[nodiscard]] virtual std::vector<double> solve(const FilterFrame& frame,
                                                  std::span<const double> readings,
                                                  double alpha) const = 0;
  /// @pre  the problem has constraints
  [[nodiscard]] virtual ConeSolution solve_in_cones(std::span<const double> readings,
                                                    double alpha) const = 0;
  [[nodiscard]] virtual std::unique_ptr<const CellCovariance> covariance(
      double alpha, double prior_alpha) const = 0;
  /// Of a covariance that this method gave; absent: it is exact.
  [[nodiscard]] virtual std::optional<BandError> band_error(const Covariance&) const { return {}; }
  /// |P W (K f - g)|
  [[nodiscard]] virtual double residual(std::span<const double> readings,
                                        std::span<const double> tractions) const = 0;
  [[nodiscard]] virtual DataVerdict judge(std::span<const double> readings,
                                          std::span<const double> tractions) const = 0;
  /// Of the last `solve`; absent: it is exact.
  [[nodiscard]] virtual std::optional<SkinConvergence> convergence() const { return {}; }
};

/// The choice is made by size alone, here: `SkinSceneProblem::is_large`. Refers to the problem.
[[nodiscard]] std::unique_ptr<const SkinMethod> method_of(const SkinSceneProblem& problem);

}  // namespace tactile_net::lab
