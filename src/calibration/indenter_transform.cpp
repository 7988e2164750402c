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

}  // namespace tactile_net
