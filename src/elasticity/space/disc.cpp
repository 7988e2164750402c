#include "tactile_net/elasticity/space/disc.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "elasticity/space/half_space_field.hpp"
#include "elasticity/space/imaginary_source.hpp"
#include "elasticity/space/read.hpp"
#include "numeric/gauss_rule.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

using std::numbers::pi;

/// g(t) for a radius and a force of 1, t in [0, 1].
double density(DiscProfile profile, double t) noexcept {
  switch (profile) {
    case DiscProfile::sphere:
      return 0.75 * (1.0 - t) * (1.0 + t);
    case DiscProfile::punch:
      return 0.5;
    case DiscProfile::cone:
      return 1.0 - t;
  }
  return 0.0;
}

}  // namespace

void check(const Disc& disc) {
  require_positive("radius", disc.radius);
  require_finite("force", disc.force);
}

double traction(const Disc& disc, double r) noexcept {
  const double a = disc.radius;
  const double s = r / a;
  if (s > 1.0) return 0.0;
  const double mean = disc.force / pi / a / a;
  const double depth = std::sqrt((1.0 - s) * (1.0 + s));
  switch (disc.profile) {
    case DiscProfile::sphere:
      return 1.5 * mean * depth;
    case DiscProfile::punch:
      return 0.5 * mean / depth;
    case DiscProfile::cone:
      return mean * std::asinh(depth / s);  // arccosh(1 / s), at its edge too
  }
  return 0.0;
}

double disc_reading(Quantity quantity, Traction component, const Material& material,
                    const Disc& disc, double depth, double y, double z) noexcept {
  const GaussRule rule = gauss_rule<20>();
  using Field = HalfSpaceField<std::complex<double>, ImaginarySource>;
  // In units of the radius: (x + i t)^2 + r^2 vanishes at t = r + i x, towards which panels shrink.
  const double a = disc.radius;
  const double x = depth / a;
  const double v = y / a;
  const double w = z / a;
  const double r = std::hypot(v, w);
  const auto at = [&](double t) {
    const ImaginarySource source(x, t, v, w);
    const Field field{source, axis(component), 1.0 - 2.0 * material.poisson_ratio};
    return density(disc.profile, t) * read(quantity, field, material).real();
  };
  const double middle = std::min(r, 1.0);
  const double nearest = std::hypot(x, r - middle);
  const auto towards = [&](double end) {  // the integral between the middle and an end
    double sum = 0.0;
    const double side = end > middle ? 1.0 : -1.0;
    double from = 0.0;
    const double width = std::abs(end - middle);
    while (from < width) {
      const double to = std::min(width, from + std::max(nearest, from));
      const double half = 0.5 * (to - from);
      for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
        for (const double sign : {-1.0, 1.0})
          sum += half * rule.weights[i] *
                 at(middle + side * (from + half * (1.0 + sign * rule.abscissa[i])));
      from = to;
    }
    return sum;
  };
  const double sum = 2.0 * disc.force * (towards(0.0) + towards(1.0)) / a;  // t < 0: the conjugate
  return traits(quantity).kind == QuantityKind::displacement ? sum : sum / a;
}

}  // namespace tactile_net
