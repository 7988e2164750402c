/// @file
/// The small system of Anderson's acceleration: which combination of what residuals changed by
/// lately comes next to the residual there is (Anderson 1965; Walker and Ni 2011). Private.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace tactile_net {

/// Pairs of changes that a step looks back on. More take no fewer steps.
inline constexpr std::size_t anderson_pairs = 5;

using AndersonSums = std::array<double, anderson_pairs>;
using AndersonGram = std::array<AndersonSums, anderson_pairs>;

/// Minimises |r - D c|, of the first `count` columns of D, by its normal equations: D is of nearly
/// dependent columns, and a c that is somewhat off only costs steps.
///
/// @param gram   D'D
/// @param right  D'r
/// @return c; zeros where the columns tell nothing, or would take the iteration far away
[[nodiscard]] inline AndersonSums anderson_weights(const AndersonGram& gram,
                                                   const AndersonSums& right,
                                                   std::size_t count) noexcept {
  constexpr double regularisation = 1e-9;  // from 1e-14 to 1e-6 the steps are the same
  constexpr double most = 1e4;
  double trace = 0.0;
  for (std::size_t i = 0; i < count; ++i) trace += gram[i][i];
  const double least = regularisation * trace;
  if (!std::isgreater(trace, 0.0) || !std::isfinite(trace) || !(least > 0.0)) return {};
  AndersonGram root{};
  AndersonSums c = right;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = gram[i][j] + (i == j ? least : 0.0);
      for (std::size_t k = 0; k < j; ++k) sum -= root[i][k] * root[j][k];
      if (j < i)
        root[i][j] = sum / root[j][j];
      else if (std::isgreater(sum, 0.1 * least))
        root[i][i] = std::sqrt(sum);
      else
        return {};
    }
    for (std::size_t k = 0; k < i; ++k) c[i] -= root[i][k] * c[k];
    c[i] /= root[i][i];
  }
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = i + 1; k < count; ++k) c[i] -= root[k][i] * c[k];
    c[i] /= root[i][i];
    if (!std::isless(std::abs(c[i]), most)) return {};
  }
  return c;
}

}  // namespace tactile_net
