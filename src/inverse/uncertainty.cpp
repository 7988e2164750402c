#include "tactile_net/inverse/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "inverse/checks.hpp"
#include "inverse/significance.hpp"
#include "inverse/weighting.hpp"
#include "realtime/line_contacts.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net {

double residual_norm(const LinearProblem& problem, std::span<const double> readings,
                     std::span<const double> tractions) {
  const std::vector<double> rows = weighted(problem, readings);
  check_tractions(tractions, problem.kernel.columns);
  const auto g = as_eigen(std::span(rows));
  // Squares of what has been divided by its size are numbers in any unit.
  const Eigen::VectorXd left = as_eigen(problem.kernel) * as_eigen(tractions) - g;
  const double scale = left.cwiseAbs().maxCoeff();
  return scale > 0.0 && std::isfinite(scale) ? (left / scale).norm() * scale : scale;
}

NoiseEstimate estimate_noise(const LinearProblem& problem, std::span<const double> readings,
                             std::span<const double> tractions, double degrees_of_freedom,
                             std::optional<double> stated_rms) {
  const double left = residual_norm(problem, readings, tractions);
  // Of a frame without any reading nothing is known.
  const std::vector<double> rows = weighted(problem, readings);
  if (as_eigen(std::span(rows)).cwiseAbs().maxCoeff() == 0.0) return {.stated_rms = stated_rms};
  return estimate_noise(left, independent_readings(problem), degrees_of_freedom, stated_rms);
}

NoiseEstimate estimate_noise(double residual, std::size_t rows, double degrees_of_freedom,
                             std::optional<double> stated_rms) {
  NoiseEstimate noise{.stated_rms = stated_rms};
  const double free = std::max(static_cast<double>(rows) - degrees_of_freedom, 1.0);
  noise.residual_rms = residual / std::sqrt(free);
  if (stated_rms) {
    const double limit = chi_squared_quantile(free, 0.01) / free;
    const double ratio = *stated_rms / noise.residual_rms;
    if (1.0 > limit * ratio * ratio)
      noise.model_rms = noise.residual_rms * std::sqrt(1.0 - ratio * ratio);
  }
  return noise;
}

UncertainResultant resultant_of(const LinearProblem& problem, std::span<const double> tractions,
                                const Covariance& covariance, double noise_rms) {
  return resultant_of(surface_of(problem.grid), tractions, covariance, noise_rms);
}

UncertainResultant resultant_between(std::size_t first, std::size_t last, const Surface& surface,
                                     std::span<const double> tractions,
                                     const Covariance& covariance, double noise_rms) {
  const std::size_t n = surface.count;
  const double d = surface.spacing;
  const bool two = tractions.size() > n;
  const Resultant sum = resultant_between(first, last, tractions.first(n),
                                          tractions.subspan(n, two ? n : std::size_t{0}), surface);
  // The gradient of each result by the tractions: F_v, F_t, the centre and the angle.
  std::vector<std::vector<double>> gradients(4, std::vector<double>(tractions.size()));
  const std::optional<double> centre = sum.centre();
  for (std::size_t i = first; i < last; ++i) {
    gradients[0][i] = d;
    if (two) gradients[1][n + i] = d;
    if (centre) gradients[2][i] = d * (surface.position(i) - *centre) / sum.normal;
  }
  if (centre && two) {
    const double slope = sum.tangential / sum.normal;
    const double scale = 1.0 / sum.normal / (1.0 + slope * slope);
    for (std::size_t i = 0; i < tractions.size(); ++i)
      gradients[3][i] = (gradients[1][i] - slope * gradients[0][i]) * scale;
  }
  const std::vector<double> deviations = covariance.deviations_of(gradients);
  const auto uncertain = [&](double value, std::size_t which) {
    return Uncertain{value, deviations[which] * noise_rms};
  };

  UncertainResultant result;
  result.normal = uncertain(sum.normal, 0);
  if (two) result.tangential = uncertain(sum.tangential, 1);
  if (centre) result.centre = uncertain(*centre, 2);
  if (centre && two) result.angle = uncertain(*sum.angle(), 3);
  gradients.pop_back();
  const Matrix all = covariance.covariances(gradients);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result.covariance[3 * i + j] = all(i, j) * noise_rms * noise_rms;
  return result;
}

UncertainResultant resultant_of(const Surface& surface, std::span<const double> tractions,
                                const Covariance& covariance, double noise_rms) {
  return resultant_between(0, surface.count, surface, tractions, covariance, noise_rms);
}

std::optional<UncertainResultant> nearest_to_slipping(
    const Surface& surface, std::span<const double> tractions, const Covariance& covariance,
    double noise_rms, const UncertainResultant& whole, const ResultantBetween& between) {
  const std::size_t n = surface.count;
  if (tractions.size() == n) return std::nullopt;
  const LineContact worst =
      nearest_to_slipping(tractions.data(), tractions.data() + n, n,
                          deviations_of_part * whole.normal.deviation / surface.spacing);
  if (worst.contacts < 2) return std::nullopt;
  if (between) return between(worst.first, worst.last);
  return resultant_between(worst.first, worst.last, surface, tractions, covariance, noise_rms);
}

}  // namespace tactile_net
