#include "calibration/disc_transform.hpp"

#include <cmath>

namespace tactile_net {

IndenterTransform disc_transform(DiscProfile profile, double z) {
  const double s = z * z;
  const double sine = std::sin(z);
  const double cosine = std::cos(z);
  // Below, series: 1 - s/10 + s^2/280 - ..., whose next terms are below rounding there.
  switch (profile) {
    case DiscProfile::sphere: {
      if (z < 0.1)
        return {1.0 - s / 10.0 * (1.0 - s / 28.0 * (1.0 - s / 54.0 * (1.0 - s / 88.0))),
                -z / 5.0 * (1.0 - s / 14.0 * (1.0 - s / 36.0 * (1.0 - s / 66.0)))};
      const double j1 = (sine / z - cosine) / z;
      const double j2 = 3.0 * j1 / z - sine / z;
      return {3.0 * j1 / z, -3.0 * j2 / z};
    }
    case DiscProfile::punch: {
      if (z < 0.1)
        return {1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0))),
                -z / 3.0 * (1.0 - s / 10.0 * (1.0 - s / 28.0 * (1.0 - s / 54.0)))};
      return {sine / z, (cosine - sine / z) / z};
    }
    case DiscProfile::cone: {
      if (z < 0.1)
        return {1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0))),
                -z / 6.0 * (1.0 - s / 15.0 * (1.0 - 3.0 * s / 112.0 * (1.0 - s / 67.5)))};
      const double half = std::sin(0.5 * z) / (0.5 * z);
      return {half * half, 2.0 * (sine - z * half * half) / s};
    }
  }
  return {};
}

}  // namespace tactile_net
