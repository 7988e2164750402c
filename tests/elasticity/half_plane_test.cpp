#include "tactile_net/elasticity/half_plane.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "tests/catch.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

using SurfaceRule = boost::math::quadrature::gauss_kronrod<double, 61>;

/// Integral over all y of kernel(y) phase(y), y = depth tan t.
double over_surface(Quantity quantity, Traction load, const Material& material, double depth) {
  const auto integrand = [&](double t) {
    const double c = std::cos(t);
    return half_plane_kernel(quantity, load, material, depth, depth * std::tan(t)) * depth /
           (c * c);
  };
  return SurfaceRule::integrate(integrand, -0.5 * pi, 0.0, 0, 0.0) +
         SurfaceRule::integrate(integrand, 0.0, 0.5 * pi, 0, 0.0);
}

bool is_even(Quantity quantity, Traction load) {
  return (quantity == Quantity::shear_xy) == (load == Traction::tangential_y);
}

constexpr Material rubber{.youngs_modulus = 3.0, .poisson_ratio = 0.4};

}  // namespace

TEST_CASE("every depth carries the whole load", "[half_plane][property]") {
  const double depth = GENERATE(1e-6, 0.3, 1.0, 7.0, 1e9);
  CAPTURE(depth);
  CHECK_THAT(over_surface(Quantity::stress_x, Traction::normal, rubber, depth),
             WithinRel(1.0, 1e-13));
  CHECK_THAT(over_surface(Quantity::shear_xy, Traction::tangential_y, rubber, depth),
             WithinRel(1.0, 1e-13));
  CHECK_THAT(over_surface(Quantity::shear_xy, Traction::normal, rubber, depth),
             WithinAbs(0.0, 1e-14));
  CHECK_THAT(over_surface(Quantity::stress_x, Traction::tangential_y, rubber, depth),
             WithinAbs(0.0, 1e-14));
}

TEST_CASE("a quarter circle around the load carries half of it", "[half_plane][property]") {
  // Equilibrium of the disk under the load: the tractions on an arc of radius r, resolved along
  // the load. This ties stress_y and both shears to stress_x.
  const double r = 2.5;
  const auto pull = [&](Traction load, bool along_x) {
    return SurfaceRule::integrate(
        [&](double angle) {
          const double x = r * std::cos(angle);
          const double y = r * std::sin(angle);
          const double stress_x = half_plane_kernel(Quantity::stress_x, load, rubber, x, y);
          const double stress_y = half_plane_kernel(Quantity::stress_y, load, rubber, x, y);
          const double shear = half_plane_kernel(Quantity::shear_xy, load, rubber, x, y);
          return along_x ? stress_x * x + shear * y : shear * x + stress_y * y;
        },
        0.0, 0.5 * pi, 0, 0.0);
  };
  CHECK_THAT(pull(Traction::normal, true), WithinRel(0.5, 1e-14));
  CHECK_THAT(pull(Traction::tangential_y, false), WithinRel(0.5, 1e-14));
}

TEST_CASE("the stress balances at every point", "[half_plane][property]") {
  // d stress_x / dx + d shear / dy = 0 and d shear / dx + d stress_y / dy = 0.
  const Traction load = GENERATE(Traction::normal, Traction::tangential_y);
  const double y = GENERATE(-2.0, -0.3, 0.0, 0.7, 4.0);
  const double x = 1.3;
  const double h = 1e-4;
  const auto k = [&](Quantity quantity, double dx, double dy) {
    return half_plane_kernel(quantity, load, rubber, x + dx, y + dy);
  };
  const auto along_x = [&](Quantity quantity) {
    return (k(quantity, h, 0.0) - k(quantity, -h, 0.0)) / (2.0 * h);
  };
  const auto along_y = [&](Quantity quantity) {
    return (k(quantity, 0.0, h) - k(quantity, 0.0, -h)) / (2.0 * h);
  };
  CHECK_THAT(along_x(Quantity::stress_x) + along_y(Quantity::shear_xy), WithinAbs(0.0, 1e-7));
  CHECK_THAT(along_x(Quantity::shear_xy) + along_y(Quantity::stress_y), WithinAbs(0.0, 1e-7));
}

TEST_CASE("a drag along +y compresses what lies ahead", "[half_plane]") {
  CHECK(half_plane_kernel(Quantity::stress_y, Traction::tangential_y, rubber, 1.0, 1.0) > 0.0);
  CHECK(half_plane_kernel(Quantity::stress_x, Traction::tangential_y, rubber, 1.0, 1.0) > 0.0);
}

TEST_CASE("a push turned by a right angle is a drag", "[half_plane][property]") {
  // The radial field of a line load depends on the angle to the load alone: exchange x and y.
  for (const double x : {0.2, 1.0, 5.0}) {
    const double y = 1.4;
    const auto push = [&](Quantity quantity) {
      return half_plane_kernel(quantity, Traction::normal, rubber, x, y);
    };
    const auto drag = [&](Quantity quantity) {
      return half_plane_kernel(quantity, Traction::tangential_y, rubber, y, x);
    };
    CHECK_THAT(drag(Quantity::stress_y), WithinRel(push(Quantity::stress_x), 1e-14));
    CHECK_THAT(drag(Quantity::stress_x), WithinRel(push(Quantity::stress_y), 1e-14));
    CHECK_THAT(drag(Quantity::shear_xy), WithinRel(push(Quantity::shear_xy), 1e-14));
  }
}

TEST_CASE("Hooke's inverse gives the stress back", "[half_plane][property]") {
  const double nu = GENERATE(0.0, 0.2, 0.45, 0.49);
  const Traction load = GENERATE(Traction::normal, Traction::tangential_y);
  CAPTURE(nu);
  const Material material{.youngs_modulus = 7.0, .poisson_ratio = nu};
  const double stiffness = 7.0 / ((1.0 + nu) * (1.0 - 2.0 * nu));
  for (const double y : {0.1, 0.9, 3.0}) {
    const auto k = [&](Quantity quantity) {
      return half_plane_kernel(quantity, load, material, 1.1, y);
    };
    const double x = k(Quantity::strain_x);
    const double across = k(Quantity::strain_y);
    const double largest =
        std::max(std::abs(k(Quantity::stress_x)), std::abs(k(Quantity::stress_y)));
    CHECK_THAT(stiffness * ((1.0 - nu) * x + nu * across),
               WithinAbs(k(Quantity::stress_x), 1e-13 * largest));
    CHECK_THAT(stiffness * ((1.0 - nu) * across + nu * x),
               WithinAbs(k(Quantity::stress_y), 1e-13 * largest));
  }
}

TEST_CASE("an incompressible pad keeps its volume, to the bit", "[half_plane][property]") {
  const Material rubber{.youngs_modulus = 2.0, .poisson_ratio = 0.5};
  for (const Traction load : {Traction::normal, Traction::tangential_y})
    for (const double y : {0.0, 0.3, 1.0, 8.0})
      CHECK(half_plane_kernel(Quantity::strain_y, load, rubber, 1.0, y) ==
            -half_plane_kernel(Quantity::strain_x, load, rubber, 1.0, y));
}

TEST_CASE("stress does not depend on the material", "[half_plane]") {
  const Material other{.youngs_modulus = 1e6, .poisson_ratio = 0.1};
  for (const Quantity quantity : {Quantity::stress_x, Quantity::stress_y, Quantity::shear_xy})
    CHECK(half_plane_kernel(quantity, Traction::normal, rubber, 1.0, 0.5) ==
          half_plane_kernel(quantity, Traction::normal, other, 1.0, 0.5));
}

TEST_CASE("far away the stress decays with its power of the distance", "[half_plane][property]") {
  // stress_x 1/y^4, stress_y 1/y^2, shear_xy 1/y^3 under a push; under a drag one power less each.
  const auto power = [](Quantity quantity, Traction load) {
    const double near = half_plane_kernel(quantity, load, rubber, 1.0, 1e4);
    const double far = half_plane_kernel(quantity, load, rubber, 1.0, 2e4);
    return std::log2(near / far);
  };
  CHECK_THAT(power(Quantity::stress_x, Traction::normal), WithinAbs(4.0, 1e-6));
  CHECK_THAT(power(Quantity::stress_y, Traction::normal), WithinAbs(2.0, 1e-6));
  CHECK_THAT(power(Quantity::shear_xy, Traction::normal), WithinAbs(3.0, 1e-6));
  CHECK_THAT(power(Quantity::stress_x, Traction::tangential_y), WithinAbs(3.0, 1e-6));
  CHECK_THAT(power(Quantity::stress_y, Traction::tangential_y), WithinAbs(1.0, 1e-6));
  CHECK_THAT(power(Quantity::shear_xy, Traction::tangential_y), WithinAbs(2.0, 1e-6));
}

TEST_CASE("a unit of length or modulus scales the kernel and nothing else",
          "[half_plane][property]") {
  const double unit = GENERATE(1e-150, 1e-3, 1e3, 1e150);
  const double stiffness = GENERATE(1e-6, 1.0, 1e9);
  CAPTURE(unit, stiffness);
  const Material scaled{.youngs_modulus = rubber.youngs_modulus * stiffness,
                        .poisson_ratio = rubber.poisson_ratio};
  for (const Quantity quantity : line_quantities)
    for (const Traction load : {Traction::normal, Traction::tangential_y})
      for (const double y : {-2.0, 0.5, 40.0}) {
        const double factor = is_strain(quantity) ? stiffness : 1.0;
        CHECK_THAT(half_plane_kernel(quantity, load, scaled, 1.5 * unit, y * unit) * unit * factor,
                   WithinRel(half_plane_kernel(quantity, load, rubber, 1.5, y), 1e-14));
        CHECK_THAT(
            half_plane_transform(quantity, load, scaled, 1.5 * unit, 0.7 / unit).real() * factor,
            WithinRel(half_plane_transform(quantity, load, rubber, 1.5, 0.7).real(), 1e-14));
      }
}

TEST_CASE("the transform is the kernel's transform", "[half_plane][property]") {
  // A trapezoidal sum of a periodic function: kernel(y) exp(-i k y) summed over y = m h equals the
  // transform at k plus its aliases at k + 2 pi n / h, which e^-a makes vanish. The tail of the
  // slow kernels is summed by Abel's means: damped with exp(-(e y)^2), extrapolated to e = 0.
  const double depth = 1.7;
  const double k = GENERATE(-2.1, -0.4, 0.3, 1.0, 2.5);
  CAPTURE(k);
  for (const Quantity quantity : line_quantities)
    for (const Traction load : {Traction::normal, Traction::tangential_y}) {
      CAPTURE(name(quantity), load == Traction::normal);
      const double h = 0.2;
      const auto damped = [&](double e) {
        std::complex<double> sum = half_plane_kernel(quantity, load, rubber, depth, 0.0);
        const int last = static_cast<int>(6.5 / (e * h));
        for (int m = 1; m <= last; ++m) {
          const double y = m * h;
          const double window = std::exp(-e * e * y * y);
          sum += window * half_plane_kernel(quantity, load, rubber, depth, y) *
                 std::polar(1.0, -k * y);
          sum += window * half_plane_kernel(quantity, load, rubber, depth, -y) *
                 std::polar(1.0, k * y);
        }
        return sum * h;
      };
      // The window's error is even in e while k / e is large: one Richardson step leaves e^4.
      const std::complex<double> sum = (4.0 * damped(0.005) - damped(0.01)) / 3.0;
      const std::complex<double> expected = half_plane_transform(quantity, load, rubber, depth, k);
      CHECK_THAT(sum.real(), WithinAbs(expected.real(), 1e-6));
      CHECK_THAT(sum.imag(), WithinAbs(expected.imag(), 1e-6));
    }
}

TEST_CASE("at k = 0 the transform is the resultant", "[half_plane]") {
  for (const Quantity quantity : line_quantities)
    for (const Traction load : {Traction::normal, Traction::tangential_y}) {
      const std::complex<double> mean = half_plane_transform(quantity, load, rubber, 1.3, 0.0);
      CHECK(mean.imag() == 0.0);
      if (is_even(quantity, load))
        CHECK_THAT(mean.real(), WithinAbs(over_surface(quantity, load, rubber, 1.3), 1e-13));
      else
        CHECK(mean.real() == 0.0);
    }
  CHECK(half_plane_transform(Quantity::stress_x, Traction::normal, rubber, 1.3, 0.0) == 1.0);
}

TEST_CASE("two stresses tell both loads apart as the determinants say", "[half_plane][property]") {
  const double depth = 0.9;
  for (const double k : {-3.0, -0.2, 0.1, 1.0, 5.0}) {
    const auto t = [&](Quantity quantity, Traction load) {
      return half_plane_transform(quantity, load, rubber, depth, k);
    };
    const auto determinant = [&](Quantity first, Quantity second) {
      return t(first, Traction::normal) * t(second, Traction::tangential_y) -
             t(first, Traction::tangential_y) * t(second, Traction::normal);
    };
    const double decay = std::exp(-2.0 * std::abs(k) * depth);
    const double sign = k > 0.0 ? 1.0 : -1.0;
    const auto with_shear = determinant(Quantity::stress_x, Quantity::shear_xy);
    CHECK_THAT(with_shear.real(), WithinRel(decay, 1e-12));
    CHECK_THAT(with_shear.imag(), WithinAbs(0.0, 1e-15));
    const auto with_stress_y = determinant(Quantity::stress_x, Quantity::stress_y);
    CHECK_THAT(with_stress_y.imag(), WithinRel(-2.0 * sign * decay, 1e-12));
    const auto strains = determinant(Quantity::strain_x, Quantity::strain_y);
    const double nu = rubber.poisson_ratio;
    const double weak = (1.0 + nu) * (1.0 + nu) * (1.0 - 2.0 * nu) /
                        (rubber.youngs_modulus * rubber.youngs_modulus);
    CHECK_THAT(strains.imag(), WithinRel(-2.0 * sign * decay * weak, 1e-11));
  }
}

TEST_CASE("a short wave dies before it arrives, without NaN", "[half_plane]") {
  const double k = GENERATE(-1e3, 1e3, 1e200, 1e308, std::numeric_limits<double>::infinity());
  const double depth = GENERATE(1.0, 1e10);
  for (const Quantity quantity : line_quantities)
    for (const Traction load : {Traction::normal, Traction::tangential_y})
      CHECK(half_plane_transform(quantity, load, rubber, depth, k) == 0.0);
}
