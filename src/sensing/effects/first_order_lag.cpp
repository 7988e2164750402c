#include "sensing/effects/first_order_lag.hpp"

#include <cmath>

namespace tactile_net {

FirstOrderLag first_order_lag(double dt, double tau) noexcept {
  const double a = dt / tau;
  const double gone = -std::expm1(-a);  // 1 - keep
  // now = 1 - gone / a, which cancels where a is small: sum of (-1)^(k+1) a^k / (k+1)!
  double now = 0.0;
  if (a < 0.5) {
    double term = -1.0;
    for (int k = 1; k <= 14; ++k) now += term *= -a / (k + 1);
  } else {
    now = 1.0 - gone / a;
  }
  return {.keep = 1.0 - gone, .before = gone - now, .now = now};
}

}  // namespace tactile_net
