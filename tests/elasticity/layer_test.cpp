#include "elasticity/layer.hpp"

#include <Eigen/LU>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/layer.hpp"
#include "tests/not_finite.hpp"

using namespace tactile_net;
using Complex = std::complex<double>;

namespace {

/// The layer solved from its boundary conditions: an Airy stress function per wavenumber,
/// phi = (A + B x) cosh kx + (C + D x) sinh kx times exp(iky), with Hooke's law for the base. It
/// shares no formula with the library but the conventions.
struct AiryLayer {
  AiryLayer(const Material& pad, Traction load, double k_)
      : k(k_), nu(pad.poisson_ratio), e(pad.youngs_modulus) {
    const double h = pad.layer->thickness;
    Eigen::Matrix4cd m;
    for (int j = 0; j < 4; ++j) {
      Eigen::Vector4cd unit = Eigen::Vector4cd::Zero();
      unit(j) = 1.0;
      c = unit;
      m(0, j) = stress_x(0.0);
      m(1, j) = shear(0.0);
      m(2, j) = pad.layer->base == Base::bonded ? strain_y(h) : shear(h);
      m(3, j) = pad.layer->base == Base::bonded ? curvature(h) : curvature_of_slip(h);
    }
    // Compression positive, and the tractions that push (+x) and drag (+y) the surface are -sigma_x
    // and -tau there in the tensile convention: equal to the readings' convention here.
    const Eigen::Vector4cd right =
        load == Traction::normal ? Eigen::Vector4cd(1, 0, 0, 0) : Eigen::Vector4cd(0, 1, 0, 0);
    c = m.fullPivLu().solve(right);
  }
  [[nodiscard]] Complex phi(double x, int d) const {  // d-th derivative in x
    const double ch = std::cosh(k * x);
    const double sh = std::sinh(k * x);
    const double a = d % 2 == 0 ? ch : sh;
    const double b = d % 2 == 0 ? sh : ch;
    const double power = std::pow(k, d);
    const double lower = d * std::pow(k, d - 1);
    return c(0) * power * a + c(1) * (power * x * a + lower * b) + c(2) * power * b +
           c(3) * (power * x * b + lower * a);
  }
  [[nodiscard]] Complex stress_x(double x) const { return -k * k * phi(x, 0); }
  [[nodiscard]] Complex stress_y(double x) const { return phi(x, 2); }
  [[nodiscard]] Complex shear(double x) const { return -i * k * phi(x, 1); }
  [[nodiscard]] Complex strain_y(double x) const {
    return ((1 - nu * nu) * stress_y(x) - nu * (1 + nu) * stress_x(x)) / e;
  }
  /// d^2 u_x / dy^2 = d(gamma)/dy - d(strain_y)/dx: zero on a bonded base with strain_y = 0.
  [[nodiscard]] Complex curvature(double x) const {
    const Complex slope = ((1 - nu * nu) * phi(x, 3) + nu * (1 + nu) * k * k * phi(x, 1)) / e;
    return i * k * 2.0 * (1 + nu) / e * shear(x) - slope;
  }
  [[nodiscard]] Complex curvature_of_slip(double x) const { return curvature(x); }
  [[nodiscard]] Complex reading(Quantity q, double x) const {
    switch (q) {
      case Quantity::stress_x:
        return stress_x(x);
      case Quantity::stress_y:
        return stress_y(x);
      case Quantity::shear_xy:
        return shear(x);
      case Quantity::strain_x:
        return ((1 - nu * nu) * stress_x(x) - nu * (1 + nu) * stress_y(x)) / e;
      case Quantity::strain_y:
        return strain_y(x);
      default:
        throw std::invalid_argument("no quantity of a line");
    }
  }
  double k, nu, e;
  Complex i{0.0, 1.0};
  Eigen::Vector4cd c;
};

}  // namespace

TEST_CASE("the layer obeys equilibrium, Hooke's law and its boundary conditions", "[layer]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.3, 0.45, 0.4999, 0.5);
  const double h = 1.3;
  const Material pad = layer(nu, h, base);
  for (const double k : {-3.0, -0.7, 0.05, 0.4, 1.0, 2.5, 6.0})
    for (const Traction load : {Traction::normal, Traction::tangential_y}) {
      const AiryLayer airy(pad, load, k);
      for (const double x : {0.02, 0.4, 1.0, 1.3})
        for (const Quantity q : line_quantities) {
          CAPTURE(name(base), nu, k, load == Traction::normal, x, name(q));
          const Complex expected = airy.reading(q, x);
          const Complex actual = layer_transform(q, load, pad, x, k);
          const double scale = is_strain(q) ? 1.0 / pad.youngs_modulus : 1.0;
          CHECK(std::abs(actual - expected) <= 1e-9 * scale + 1e-9 * std::abs(expected));
        }
    }
}

TEST_CASE("the base of a bonded layer inverts as its determinant says", "[layer]") {
  const double nu = GENERATE(0.0, 0.45, 0.5);
  const double k = GENERATE(0.01, 0.5, 3.0, 20.0);
  const double h = 0.8;
  const Material pad = layer(nu, h, Base::bonded);
  const auto at = [&](Quantity q, Traction load) { return layer_transform(q, load, pad, h, k); };
  const Complex determinant =
      at(Quantity::stress_x, Traction::normal) * at(Quantity::shear_xy, Traction::tangential_y) -
      at(Quantity::stress_x, Traction::tangential_y) * at(Quantity::shear_xy, Traction::normal);
  const double n = 2.0 - 2.0 * nu;
  const double m = 1.0 - 2.0 * nu;
  const double c = std::cosh(k * h);
  const double delta = (3.0 - 4.0 * nu) * c * c + k * h * k * h + m * m;
  CHECK_THAT(determinant.real(), WithinRel(n * n / delta, 1e-11));
  CHECK_THAT(determinant.imag(), WithinAbs(0.0, 1e-15));
}

TEST_CASE("a deep layer is a half plane, at any k h", "[layer]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.45, 0.5);
  const double kh = GENERATE(60.0, 300.0, 2000.0, 1e6, 1e300);
  const double h = 1.0;
  const Material pad = layer(nu, h, base);
  for (const double a : {1e-3, 0.5, 1.0, 3.0, 15.0})
    for (const Traction load : {Traction::normal, Traction::tangential_y})
      for (const Quantity q : line_quantities) {
        const double k = kh / h;
        const double x = a / k;
        CAPTURE(name(base), nu, kh, a, load == Traction::normal, name(q));
        const Complex half = half_plane_transform(q, load, pad, x, k);
        const double scale = (is_strain(q) ? 1.0 / pad.youngs_modulus : 1.0) * std::exp(-a);
        CHECK(std::abs(layer_transform(q, load, pad, x, k) - half) <= 1e-14 * (2.0 + a) * scale);
      }
}

TEST_CASE("nothing in a layer overflows or is lost", "[layer]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const Material pad = layer(0.5, 2.0, base);
  for (const double k : {0.0, 1e-300, 1e-9, 1e3, 1e9, 1e300, infinite})
    for (const double depth : {1e-9, 1.0, 2.0})
      for (const Traction load : {Traction::normal, Traction::tangential_y})
        for (const Quantity q : line_quantities) {
          CAPTURE(name(base), k, depth, name(q));
          const bool pole = base == Base::frictionless && load == Traction::tangential_y &&
                            k > 0.0 && (q == Quantity::stress_y || is_strain(q));
          const Complex value = layer_transform(q, load, pad, depth, k);
          if (pole && k < 1e-200) continue;  // -i/(k h)
          CHECK(std::isfinite(value.real()));
          CHECK(std::isfinite(value.imag()));
        }
}

TEST_CASE("k = 0 is the limit of small k", "[layer]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const Material pad = layer(0.3, 2.0, base);
  for (const Traction load : {Traction::normal, Traction::tangential_y})
    for (const Quantity q : line_quantities) {
      if (base == Base::frictionless && load == Traction::tangential_y && q != Quantity::shear_xy &&
          q != Quantity::stress_x)
        continue;
      const Complex near = layer_transform(q, load, pad, 0.7, 1e-7);
      CHECK(std::abs(layer_transform(q, load, pad, 0.7, 0.0) - near) < 1e-6);
    }
}

TEST_CASE("a layer's kernel is the inverse transform, to 1e-9 of the peak and better",
          "[pad_kernel]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.5);
  const double h = 1.7;
  const double depth = h * GENERATE(0.02, 0.5, 1.0);
  const Material pad = layer(nu, h, base);
  for (const Traction load : {Traction::normal, Traction::tangential_y})
    for (const Quantity q : line_quantities) {
      const PadKernel kernel(q, load, pad, depth);
      const double peak = 2.0 / (3.14 * depth) / (is_strain(q) ? pad.youngs_modulus : 1.0);
      for (const double y : {0.0, 0.013, -1.1, 7.0}) {
        CAPTURE(name(base), nu, depth, load == Traction::normal, name(q), y);
        // Against adaptive quadrature of the whole transform: no split into half plane and rest.
        const auto integrand = [&](double k) {
          return (layer_transform(q, load, pad, depth, k) * std::polar(1.0, k * y)).real() /
                 3.141592653589793238;
        };
        double sum = 0.0;
        const double end = 45.0 / depth;
        const int parts = static_cast<int>(std::ceil(end * (std::abs(y) + h) / 2.0)) + 4;
        for (int p = 0; p < parts; ++p)
          sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
              integrand, end * p / parts, end * (p + 1) / parts, 0);
        CHECK_THAT((kernel(y) - sum) / peak, WithinAbs(0.0, 2e-12));
      }
    }
}

TEST_CASE("far away a layer's kernel meets its limit without a step", "[pad_kernel]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const Material pad = layer(0.5, 0.5, base);
  for (const Traction load : {Traction::normal, Traction::tangential_y})
    for (const Quantity q : line_quantities) {
      const PadKernel kernel(q, load, pad, 0.5);
      CAPTURE(name(base), name(q), load == Traction::normal);
      const double scale = 4.0 / (is_strain(q) ? pad.youngs_modulus : 1.0);
      CHECK(std::abs(kernel(23.999) - kernel(24.001)) < 1e-13 * scale);
      CHECK(std::abs(kernel(-23.999) - kernel(-24.001)) < 1e-13 * scale);
      CHECK(kernel(1e6) == kernel(1e9));
    }
}

TEST_CASE("a base that slips carries the tangential load as stress_y, half on each side",
          "[pad_kernel]") {
  const Material pad = layer(0.3, 2.0, Base::frictionless);
  const PadKernel kernel(Quantity::stress_y, Traction::tangential_y, pad, 1.2);
  CHECK_THAT(kernel(60.0), WithinRel(0.25, 1e-12));
  CHECK_THAT(kernel(-60.0), WithinRel(-0.25, 1e-12));
  CHECK_THAT(kernel(200.0), WithinRel(0.25, 1e-15));
}

TEST_CASE("no depth below the base", "[pad_kernel]") {
  const Material pad = layer(0.3, 2.0, Base::bonded);
  CHECK_THROWS_WITH(PadKernel(Quantity::stress_x, Traction::normal, pad, 2.1),
                    "depth must be at most the layer's thickness (got 2.1)");
  CHECK_THROWS_WITH(check(layer(0.3, -1.0, Base::bonded)), "layer.thickness must be > 0 (got -1)");
}
