/// @file
/// How far one set of tractions is from another.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace tactile_net {

/// Mean of |f - reference| [Pa] (thesis 3.17); 0 for no values.
[[nodiscard]] inline double mean_absolute_error(std::span<const double> f,
                                                std::span<const double> reference) noexcept {
  assert(f.size() == reference.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += std::abs(f[i] - reference[i]);
  return f.empty() ? 0.0 : sum / static_cast<double>(f.size());
}

/// |f - reference|_2 / |reference|_2; NaN if the reference is zero everywhere. Free of overflow and
/// underflow: both norms are scaled by their largest entry.
[[nodiscard]] inline double relative_l2_error(std::span<const double> f,
                                              std::span<const double> reference) noexcept {
  assert(f.size() == reference.size());
  double scale = 0.0;
  for (const double value : reference) scale = std::fmax(scale, std::abs(value));
  if (!(scale > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double error = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double difference = f[i] / scale - reference[i] / scale;
    error += difference * difference;
    size += reference[i] / scale * (reference[i] / scale);
  }
  return std::sqrt(error / size);
}

/// |values|_2, free of overflow and underflow.
[[nodiscard]] inline double l2_norm(std::span<const double> values) noexcept {
  double norm = 0.0;
  for (const double value : values) norm = std::hypot(norm, value);
  return norm;
}

/// `relative_l2_error`; |f|_2 itself where the reference is zero.
[[nodiscard]] inline double l2_difference(std::span<const double> f,
                                          std::span<const double> reference) noexcept {
  const double relative = relative_l2_error(f, reference);
  return std::isnan(relative) && l2_norm(reference) == 0.0 ? l2_norm(f) : relative;
}

/// Force [N/m] of sampled tractions: pitch times their sum.
[[nodiscard]] inline double sampled_force(std::span<const double> tractions,
                                          double pitch) noexcept {
  double sum = 0.0;
  for (const double traction : tractions) sum += traction;
  return pitch * sum;
}

}  // namespace tactile_net
