/// @file
/// How sure a share of draws is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tactile_net {

/// Where the share of all lies in 95 of 100 such draws (Wilson 1927); of none: anywhere.
///
/// @param within  of the `count` that were drawn, <= count
[[nodiscard]] inline std::pair<double, double> share_interval(std::size_t within,
                                                              std::size_t count) noexcept {
  if (count == 0) return {0.0, 1.0};
  constexpr double z = 1.959963984540054;
  const auto n = static_cast<double>(count);
  const double share = static_cast<double>(within) / n;
  const double middle = (share + 0.5 * z * z / n) / (1.0 + z * z / n);
  const double half =
      z / (1.0 + z * z / n) * std::sqrt(share * (1.0 - share) / n + 0.25 * z * z / (n * n));
  return {std::max(middle - half, 0.0), std::min(middle + half, 1.0)};
}

/// Which of `count` draws, counted from 1 in rising order, the quantile of a share of all lies
/// between in 95 of 100 such draws, whatever they are distributed like (Clopper and Pearson 1934).
/// 0, and `count` + 1: none of them bounds it.
[[nodiscard]] inline std::pair<std::size_t, std::size_t> quantile_ranks(std::size_t count,
                                                                        double share) noexcept {
  constexpr double outside = 0.025;  // on either side
  const auto n = static_cast<double>(count);
  double below = 0.0;  // the probability that fewer than `rank` draws are below the quantile
  std::pair<std::size_t, std::size_t> ranks{0, count + 1};
  for (std::size_t rank = 0; rank <= count; ++rank) {
    const auto k = static_cast<double>(rank);
    // The draw of this rank is below the quantile unless fewer are.
    if (below <= outside) ranks.first = rank;
    if (1.0 - below <= outside) {
      ranks.second = rank;
      break;
    }
    below += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                      k * std::log(share) + (n - k) * std::log1p(-share));
  }
  return ranks;
}

}  // namespace tactile_net
