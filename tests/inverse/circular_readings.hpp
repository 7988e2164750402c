/// @file
/// Readings of tractions on a circle.
#pragma once

#include <vector>

#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {

/// The circular system's own readings: every lag taken around the circle.
inline std::vector<double> circular_readings(const SensorArray& array, const Material& material,
                                             const std::vector<double>& f) {
  const std::size_t n = array.count;
  std::vector<double> g;
  for (const Channel& channel : channels(array)) {
    std::vector<double> row(n);
    for (std::size_t u = 0; u < f.size() / n; ++u) {
      const std::vector<double> kernel = sampled_kernel(
          channel, u == 0 ? Traction::normal : Traction::tangential_y, material, n, array.pitch);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const std::size_t lag = (i + n - j) % n;
          const double forward = kernel[n - 1 + lag];
          const double backward = lag == 0 ? forward : kernel[lag - 1];
          const double k = 2 * lag < n   ? forward
                           : 2 * lag > n ? backward
                                         : 0.5 * (forward + backward);
          row[i] += k * f[u * n + j];
        }
    }
    g.insert(g.end(), row.begin(), row.end());
  }
  return g;
}

}  // namespace tactile_net
