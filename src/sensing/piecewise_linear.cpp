#include "tactile_net/sensing/piecewise_linear.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net {

double PiecewiseLinear::operator()(double t) const noexcept {
  const auto next = std::upper_bound(times.begin(), times.end(), t);
  if (next == times.begin()) return values.front();
  if (next == times.end()) return values.back();
  const auto i = static_cast<std::size_t>(next - times.begin());
  return std::lerp(values[i - 1], values[i], (t - times[i - 1]) / (times[i] - times[i - 1]));
}

}  // namespace tactile_net
