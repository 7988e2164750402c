#include "elasticity/layer.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <complex>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/layer.hpp"
#include "tests/not_finite.hpp"

using namespace tactile_net;
using Complex = std::complex<double>;

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
