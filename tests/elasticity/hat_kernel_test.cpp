#include "tactile_net/elasticity/hat_kernel.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "elasticity/layer.hpp"
#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

using FiftyDigits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                                  boost::multiprecision::et_off>;

/// Gauss-Legendre over [-width, width], by panels that grow by powers of 4 with the distance from
/// the taxel at u and meet at the hat's corners: `add(s, weight of ds)`.
template <class Number, unsigned points>
void over_hat(Number u, Number depth, Number width, const auto& add) {
  using std::abs;
  std::vector<Number> borders{-width, Number(0), width};
  const auto border = [&](Number s) {
    if (abs(s) < width) borders.push_back(s);
  };
  border(u);
  for (Number r = depth; r < width + abs(u); r *= 4) {
    border(u - r);
    border(u + r);
  }
  std::sort(borders.begin(), borders.end());
  using Rule = boost::math::quadrature::gauss<Number, points>;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const Number centre = (borders[i] + borders[i + 1]) / 2;
    const Number half = (borders[i + 1] - borders[i]) / 2;
    for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
      const Number offset = half * Rule::abscissa()[k];
      add(centre + offset, half * Rule::weights()[k]);
      if (offset != 0) add(centre - offset, half * Rule::weights()[k]);
    }
  }
}

/// The stresses below a hat on a half plane to 25 digits: x, y, shear of a normal load, then of a
/// tangential one.
std::array<FiftyDigits, 6> stresses(double u, double depth, double width) {
  std::array<FiftyDigits, 6> sum{};
  const FiftyDigits x = depth;
  over_hat<FiftyDigits, 30>(u, x, FiftyDigits(width), [&](FiftyDigits s, FiftyDigits weight) {
    const FiftyDigits y = u - s;
    const FiftyDigits r2 = x * x + y * y;
    const FiftyDigits f =
        weight * (1 - abs(s) / width) * 2 / (boost::math::constants::pi<FiftyDigits>() * r2 * r2);
    sum[0] += f * x * x * x;
    sum[1] += f * x * y * y;
    sum[2] += f * x * x * y;
    sum[4] += f * y * y * y;
  });
  sum[3] = sum[2];
  sum[5] = sum[1];
  return sum;
}

FiftyDigits reading(Quantity quantity, Traction component, const Material& material,
                    const std::array<FiftyDigits, 6>& stresses) {
  const std::size_t first = component == Traction::normal ? 0 : 3;
  const FiftyDigits x = stresses[first];
  const FiftyDigits y = stresses[first + 1];
  const FiftyDigits nu = material.poisson_ratio;
  switch (quantity) {
    case Quantity::stress_x:
      return x;
    case Quantity::stress_y:
      return y;
    case Quantity::shear_xy:
      return stresses[first + 2];
    case Quantity::strain_x:
      return (1 + nu) * ((1 - nu) * x - nu * y) / material.youngs_modulus;
    case Quantity::strain_y:
      return (1 + nu) * ((1 - nu) * y - nu * x) / material.youngs_modulus;
    default:
      throw std::invalid_argument("no quantity of a line");
  }
}

Material half_plane_of(double nu) { return {.youngs_modulus = 3.0, .poisson_ratio = nu}; }

Material layer(Base base, double nu, double thickness = 1.3) {
  return {.youngs_modulus = 3.0, .poisson_ratio = nu, .layer = Layer{thickness, base}};
}

/// Largest reading of a hat on a half plane.
double peak(Quantity quantity, Traction component, const Material& material, double depth,
            double width) {
  Material deep = material;
  deep.layer.reset();
  const HatKernel hat(quantity, component, deep, depth, width);
  double largest = 0.0;
  for (const double u : {0.0, width, width / 2, depth / 2, depth, 1.7 * depth, width + depth})
    largest = std::max(largest, std::abs(hat(u)));
  return largest;
}

void for_every_kernel(const auto& check) {
  for (const Quantity quantity : line_quantities)
    for (const Traction component : line_tractions) {
      CAPTURE(name(quantity), name(component));
      check(quantity, component);
    }
}

}  // namespace

TEST_CASE("a hat is read as the integral says to 50 digits, deep, shallow and far",
          "[hat_kernel]") {
  const double depth = 0.7;
  const double width = depth * GENERATE(1e-6, 0.25, 0.33, 0.36, 1.0, 3.0, 1e3, 1e6);
  CAPTURE(width / depth);
  const std::vector<double> places = {
      0.0,         depth / 3,         -depth,         width,         -width,        width / 2,
      2.0 * width, width + depth / 2, -width - depth, 2.999 * width, 3.001 * width, 30.0 * depth,
      1e4 * depth};
  std::vector<std::array<FiftyDigits, 6>> expected;
  for (const double u : places) expected.push_back(stresses(u, depth, width));
  for (const double nu : {0.0, 0.45, 0.5})
    for_every_kernel([&](Quantity quantity, Traction component) {
      const Material material = half_plane_of(nu);
      const HatKernel hat(quantity, component, material, depth, width);
      const double scale = peak(quantity, component, material, depth, width);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const FiftyDigits exact = reading(quantity, component, material, expected[i]);
        const auto error = static_cast<double>(abs(hat(places[i]) - exact));
        CAPTURE(nu, places[i]);
        CHECK(error < 5e-14 * scale);
        CHECK(error < hat.error_bound(places[i]));
      }
    });
}

TEST_CASE("in a layer a hat is the integral of the layer's kernel", "[hat_kernel][layer]") {
  const Base base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = base == Base::bonded ? 0.5 : 0.0;
  const double thickness = 1.3;
  const double depth = thickness * GENERATE(0.01, 1.0);
  const double width = thickness * GENERATE(0.1, 3.0, 200.0);
  CAPTURE(name(base), nu, depth / thickness, width / thickness);
  const Material pad = layer(base, nu, thickness);
  for_every_kernel([&](Quantity quantity, Traction component) {
    const PadKernel kernel(quantity, component, pad, depth);
    const HatKernel hat(quantity, component, pad, depth, width);
    // The kernel's own error, summed over the hat, is what limits this comparison.
    const double line = std::max(
        std::abs(half_plane_kernel(quantity, component, half_plane_of(nu), thickness, 0.0)),
        std::abs(half_plane_kernel(quantity, component, half_plane_of(nu), thickness, thickness)));
    const double tolerance = 4e-13 * (peak(quantity, component, pad, depth, width) + line * width);
    for (const double u : {0.0, 0.3 * depth, -width, 0.4 * width, width + 2.0 * thickness,
                           47.0 * thickness, width + 49.0 * thickness}) {
      double sum = 0.0;
      over_hat<double, 30>(u, depth, width, [&](double s, double weight) {
        sum += weight * (1.0 - std::abs(s) / width) * kernel(u - s);
      });
      CAPTURE(u);
      CHECK_THAT(hat(u), WithinAbs(sum, tolerance));
    }
  });
}

TEST_CASE("the hats of a grid reproduce straight lines", "[hat_kernel][property]") {
  // A hat is the sum of narrower ones with its own values at their middles.
  const double depth = 0.8;
  const Material pad =
      GENERATE(half_plane_of(0.45), layer(Base::bonded, 0.45), layer(Base::frictionless, 0.3));
  const double narrow = GENERATE(0.2, 9.0);
  const int parts = 3;
  CAPTURE(pad.layer.has_value(), narrow);
  for_every_kernel([&](Quantity quantity, Traction component) {
    const HatKernel wide(quantity, component, pad, depth, parts * narrow);
    const HatKernel hat(quantity, component, pad, depth, narrow);
    for (const double u : {0.0, 0.3, -1.7, 11.0, parts * narrow, -80.0}) {
      double sum = 0.0;
      for (int i = 1 - parts; i < parts; ++i)
        sum += (1.0 - std::abs(i) / static_cast<double>(parts)) * hat(u - i * narrow);
      CAPTURE(u);
      CHECK_THAT(wide(u),
                 WithinAbs(sum, parts * 1e-13 * peak(quantity, component, pad, depth, narrow)));
    }
  });
}

TEST_CASE("a grid of hats is a plateau, which a pad carries as it carries a uniform load",
          "[hat_kernel][property]") {
  const auto plateau = [](Quantity quantity, Traction component, const Material& pad, double depth,
                          double spacing, int reach, double u) {
    const HatKernel hat(quantity, component, pad, depth, spacing);
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) sum += hat(u - i * spacing);
    return sum;
  };
  const double u = GENERATE(0.0, 0.013, -0.4);
  SECTION("far from its ends a half plane's stress_x is the pressure, its shear the drag") {
    const Material pad = half_plane_of(0.45);  // the ends are (depth / distance)^3 away
    CHECK_THAT(plateau(Quantity::stress_x, Traction::normal, pad, 0.01, 0.1, 800, u),
               WithinAbs(1.0, 1e-11));
    CHECK_THAT(plateau(Quantity::stress_x, Traction::tangential_y, pad, 0.01, 0.1, 800, 0.0),
               WithinAbs(0.0, 1e-13));
  }
  SECTION("a bonded layer is in uniaxial strain, and sheared throughout") {
    const double nu = GENERATE(0.0, 0.3, 0.5);
    const Material pad = layer(Base::bonded, nu);
    for (const double depth : {0.2, 1.3}) {
      CHECK_THAT(plateau(Quantity::stress_x, Traction::normal, pad, depth, 0.5, 160, u),
                 WithinAbs(1.0, 2e-12));
      CHECK_THAT(plateau(Quantity::stress_y, Traction::normal, pad, depth, 0.5, 160, u),
                 WithinAbs(nu / (1.0 - nu), 2e-12));
      CHECK_THAT(plateau(Quantity::strain_y, Traction::normal, pad, depth, 0.5, 160, u),
                 WithinAbs(0.0, 2e-12));
      CHECK_THAT(plateau(Quantity::shear_xy, Traction::tangential_y, pad, depth, 0.5, 160, u),
                 WithinAbs(1.0, 2e-12));
    }
  }
  SECTION("a layer on a base that slips is in uniaxial stress") {
    const Material pad = layer(Base::frictionless, 0.3);
    CHECK_THAT(plateau(Quantity::stress_x, Traction::normal, pad, 0.7, 0.5, 160, u),
               WithinAbs(1.0, 2e-12));
    CHECK_THAT(plateau(Quantity::stress_y, Traction::normal, pad, 0.7, 0.5, 160, u),
               WithinAbs(0.0, 2e-12));
  }
}

TEST_CASE("a narrow hat is a line load of its area", "[hat_kernel][property]") {
  const Material pad =
      GENERATE(half_plane_of(0.45), layer(Base::bonded, 0.5), layer(Base::frictionless, 0.0));
  const double depth = 1.1;
  for_every_kernel([&](Quantity quantity, Traction component) {
    const PadKernel line(quantity, component, pad, depth);
    const HatKernel narrow(quantity, component, pad, depth, 1e-9);
    const HatKernel wide(quantity, component, pad, depth, 0.02);
    const HatKernel half(quantity, component, pad, depth, 0.01);
    for (const double u : {0.0, 0.2, -1.3, 5.0, 61.0}) {
      CHECK_THAT(narrow(u) / 1e-9, WithinAbs(line(u), 2e-13));
      // What is left is width^2 k'' / 12.
      CHECK_THAT(wide(u) / 0.02 - line(u), WithinAbs(4.0 * (half(u) / 0.01 - line(u)), 2e-8));
    }
  });
}

TEST_CASE("a hat's reading is even or odd, to the bit", "[hat_kernel][property]") {
  const Material pad =
      GENERATE(half_plane_of(0.45), layer(Base::bonded, 0.45), layer(Base::frictionless, 0.45));
  const double width = GENERATE(0.1, 20.0);
  for_every_kernel([&](Quantity quantity, Traction component) {
    const HatKernel hat(quantity, component, pad, 0.9, width);
    for (const double u : {1e-9, 0.05, 0.1, 3.0, 20.0, 100.0})
      CHECK(hat(-u) == (is_odd(quantity, component) ? -hat(u) : hat(u)));
    if (is_odd(quantity, component)) CHECK(std::abs(hat(0.0)) < 1e-15);
  });
}

TEST_CASE("a unit of length or modulus scales a hat's reading and nothing else",
          "[hat_kernel][property]") {
  const double unit = GENERATE(1e-150, 1e-3, 1e150);
  const double stiffness = GENERATE(1e-6, 1e9);
  const double width = GENERATE(0.1, 4.0);
  for_every_kernel([&](Quantity quantity, Traction component) {
    const Material pad = half_plane_of(0.4);
    Material scaled = pad;
    scaled.youngs_modulus *= stiffness;
    const double factor = is_strain(quantity) ? stiffness : 1.0;
    const HatKernel before(quantity, component, pad, 1.5, width);
    const HatKernel after(quantity, component, scaled, 1.5 * unit, width * unit);
    for (const double u : {0.3, -2.0, 40.0})
      CHECK_THAT(after(u * unit) * factor, WithinRel(before(u), 1e-12));
  });
}

TEST_CASE("no hat without a width, none below the base", "[hat_kernel]") {
  const Material pad = layer(Base::bonded, 0.3, 2.0);
  const auto make = [&](double depth, double width) {
    return HatKernel(Quantity::stress_x, Traction::normal, pad, depth, width);
  };
  CHECK_THROWS_WITH(make(1.0, 0.0), "half_width must be > 0 (got 0)");
  CHECK_THROWS_WITH(make(2.1, 1.0), "depth must be at most the layer's thickness (got 2.1)");
  CHECK_THROWS_WITH(make(-1.0, 1.0), "depth must be > 0 (got -1)");
  CHECK_THROWS_WITH(HatKernel(Quantity::stress_x, Traction::normal, {.poisson_ratio = 0.6}, 1, 1),
                    StartsWith("poisson_ratio"));
}
