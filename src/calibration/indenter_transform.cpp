#include "calibration/indenter_transform.hpp"

#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <numbers>

namespace tactile_net {
namespace {

using Plain = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

double j0(double z) { return boost::math::cyl_bessel_j(0, z, Plain{}); }
double j1(double z) { return boost::math::cyl_bessel_j(1, z, Plain{}); }

/// 1/z integral_0^z J0 = 2/pi integral_0^(pi/2) sin(z sin u) / (z sin u) du. The integrand is
/// analytic and of period pi: the mid-point sum converges faster than any power once it has more
/// points than z.
double mean_of_j0(double z) {
  const auto points = static_cast<int>(std::ceil(z)) + 24;
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double angle = z * std::sin(std::numbers::pi * (i + 0.5) / (2.0 * points));
    sum += angle < 1e-4 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  }
  return sum / points;
}

}  // namespace

IndenterTransform indenter_transform(Shape shape, double z) {
  const bool small = z < 1e-4;  // series, to z^4
  switch (shape) {
    case Shape::cylinder: {
      if (small) return {1.0 - z * z / 8.0, -z / 4.0};
      const double share = 2.0 * j1(z) / z;
      return {share, 2.0 * (j0(z) - share) / z};  // -2 J2 / z, J2 = 2 J1 / z - J0
    }
    case Shape::punch:
      return {j0(z), -j1(z)};
    case Shape::wedge: {
      if (small) return {1.0 - z * z / 12.0, -z / 6.0};
      const double mean = mean_of_j0(z);
      return {mean, (j0(z) - mean) / z};
    }
  }
  return {};
}

IndenterTransform indenter_transform(DiscProfile profile, double z) {
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
