#include "tactile_net/elasticity/space/skin_kernel.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/elasticity/space/skin_transform.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/layer.hpp"

using namespace tactile_net;
using std::numbers::pi;
using Complex = std::complex<double>;

namespace {

bool is_defined(Quantity quantity, Traction component, const Material& material) {
  return traits(quantity).kind != QuantityKind::displacement || traits(quantity).first == Axis::x ||
         component == Traction::normal || material.layer->base == Base::bonded;
}

/// The inverse transforms at (r, angle) for some r, by the symbol alone: its orders in the
/// direction of k by seven samples, then Hankel integrals of the whole of it; no split into half
/// space and rest.
template <std::size_t count>
std::array<double, count> inverse(Quantity q, Traction load, const Material& material, double depth,
                                  const std::array<double, count>& distances, double place_angle) {
  using Rule = boost::math::quadrature::gauss<double, 12>;
  // Panels that resolve the farthest place's waves, and the pole of a bonded layer at 0.739 i / h.
  const double width = 0.7 / std::max(material.layer->thickness, 0.2 * distances.back());
  const auto panels = static_cast<int>(std::ceil(42.0 / depth / width));
  std::array<Complex, count> sums{};
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        const double k = (panel + 0.5 + 0.5 * side * Rule::abscissa()[i]) * width;
        std::array<Complex, 7> order{};  // -3 ... 3
        for (int s = 0; s < 7; ++s) {
          const double angle = 2.0 * pi * s / 7.0 + 0.1;
          const Complex value =
              skin_transform(q, load, material, depth, k * std::cos(angle), k * std::sin(angle));
          for (int j = -3; j <= 3; ++j)
            order[static_cast<std::size_t>(j + 3)] += value * std::polar(1.0 / 7.0, -j * angle);
        }
        const double weight = 0.5 * width * Rule::weights()[i] * k / (2.0 * pi);
        for (std::size_t n = 0; n < count; ++n)
          for (int j = -3; j <= 3; ++j)
            sums[n] += weight * order[static_cast<std::size_t>(j + 3)] *
                       std::polar(1.0, j * (0.5 * pi + place_angle)) *
                       boost::math::cyl_bessel_j(j, k * distances[n]);
      }
  std::array<double, count> values{};
  std::transform(sums.begin(), sums.end(), values.begin(), [](Complex sum) { return sum.real(); });
  return values;
}

}  // namespace

TEST_CASE("a skin's kernel is the inverse transform of its symbol, within its bound",
          "[skin_kernel]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.5);
  const double h = 1.6;
  const double depth = h * GENERATE(0.3, 1.0);
  const Material material = layer(nu, h, base);
  const SkinKernel kernel(material, depth);
  const std::array distances{0.0, 0.3, 1.5, 7.1};
  const double angle = 0.7;
  for (const Traction load : {Traction::normal, Traction::tangential_y})
    for (const Quantity q : skin_quantities) {
      if (traits(q).kind == QuantityKind::strain || !is_defined(q, load, material)) continue;
      const auto expected = inverse(q, load, material, depth, distances, angle);
      for (std::size_t n = 0; n < distances.size(); ++n) {
        const double y = distances[n] * std::cos(angle);
        const double z = distances[n] * std::sin(angle);
        CAPTURE(name(base), nu, depth, distances[n], name(q), name(load));
        CHECK_THAT(kernel(q, load, y, z), WithinAbs(expected[n], kernel.error_bound(q)));
      }
    }
}

TEST_CASE("a drag along z is one along y, in exchanged axes", "[skin_kernel][property]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const Material material = layer(0.3, 1.0, base);
  const SkinKernel kernel(material, 0.5);
  for (const Quantity q : skin_quantities) {
    if (!is_defined(q, Traction::tangential_y, material)) continue;
    for (const double y : {0.2, -50.0})
      CHECK(kernel(q, Traction::tangential_z, y, 0.7) ==
            kernel(exchanged(q), Traction::tangential_y, 0.7, y));
  }
}

TEST_CASE("a layer's point loads in a row are the line load of a line array",
          "[skin_kernel][property]") {
  // Bonded: on a frictionless base a drag falls as 1 / r, and a row of them without end has no sum.
  const double depth = GENERATE(0.4, 1.0);
  const Material material = layer(0.4, 1.0, Base::bonded);
  const SkinKernel kernel(material, depth);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (const Traction load : line_tractions) {
    for (const Quantity q : line_quantities) {
      const PadKernel line(q, load, material, depth);
      for (const double y : {0.0, 0.8, -3.0}) {
        double sum = 0.0;
        for (int panel = 0; panel < 46; ++panel)
          sum += 2.0 * Rule::integrate([&](double z) { return kernel(q, load, y, z); }, panel * 1.0,
                                       panel + 1.0);
        CAPTURE(depth, name(q), name(load), y);
        CHECK_THAT(sum, WithinAbs(line(y), 2e-12 * 2.0 / pi / depth));
      }
    }
  }
}

TEST_CASE("every plane of a bonded layer carries the whole load", "[skin_kernel][property]") {
  const Material material = layer(GENERATE(0.0, 0.3, 0.5), 1.0, Base::bonded);
  const SkinKernel kernel(material, GENERATE(0.3, 1.0));
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (const Traction load : skin_tractions)
    for (const Quantity q : {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}) {
      double sum = 0.0;
      for (int panel = 0; panel < 96; ++panel)
        sum += Rule::integrate(
            [&](double r) {
              double ring = 0.0;
              for (int i = 0; i < 8; ++i)
                ring += kernel(q, load, r * std::cos(pi * (i + 0.5) / 4.0),
                               r * std::sin(pi * (i + 0.5) / 4.0));
              return ring * pi / 4.0 * r;
            },
            0.5 * panel, 0.5 * (panel + 1));
      CAPTURE(name(q), name(load));
      CHECK_THAT(sum,
                 WithinAbs(static_cast<int>(load) == static_cast<int>(traits(q).second), 1e-11));
    }
}

TEST_CASE("a thick layer reads like a half space", "[skin_kernel]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const Material material = layer(0.4, 1e4, base);
  Material half = material;
  half.layer.reset();
  const SkinKernel kernel(material, 1.0);
  const SkinKernel other(half, 1.0);
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      if (!is_defined(q, load, material)) continue;
      const double size = traits(q).kind == QuantityKind::displacement ? 1e-3 : 1e-7;
      CHECK_THAT(kernel(q, load, 0.4, -0.9), WithinAbs(other(q, load, 0.4, -0.9), size));
      CHECK(other(q, load, 0.4, -0.9) == half_space_kernel(q, load, half, 1.0, 0.4, -0.9));
    }
}

TEST_CASE("far away a skin's kernel meets its closed form without a step", "[skin_kernel]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.3, 0.5);
  const double h = 0.5;
  const double depth = h * GENERATE(0.2, 1.0);
  const Material material = layer(nu, h, base);
  const SkinKernel kernel(material, depth);
  const double out = 48.0 * h;
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      if (!is_defined(q, load, material)) continue;
      for (const double theta : {0.0, 0.3, 2.1}) {
        const auto at = [&](double r) {
          return kernel(q, load, r * std::cos(theta), r * std::sin(theta));
        };
        // By more than the slope over so short a way.
        const double step = std::abs(at(out * (1.0 - 1e-12)) - at(out * (1.0 + 1e-12)));
        CAPTURE(name(base), nu, depth, name(q), name(load), theta);
        CHECK(step <= kernel.error_bound(q) + 1e-11 * std::abs(at(out)));
        if (base == Base::bonded) CHECK(at(2.0 * out) == 0.0);
        CHECK(std::abs(at(1e160)) <= 1e-150);
      }
    }
}

TEST_CASE("a layer's kernels are even or odd, and scale, to the bit", "[skin_kernel][property]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const SkinKernel kernel(layer(0.3, 1.0, base), 0.75);
  const double unit = GENERATE(std::exp2(-498.0), std::exp2(498.0));
  const SkinKernel scaled(layer(0.3, unit, base), 0.75 * unit);
  const Rectangle cell{0.3, 0.2};
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      if (!is_defined(q, load, layer(0.3, 1.0, base))) continue;
      const double y_sign = is_odd(q, load, Axis::y) ? -1.0 : 1.0;
      const double z_sign = is_odd(q, load, Axis::z) ? -1.0 : 1.0;
      const double area = unit * (traits(q).kind == QuantityKind::displacement ? 1.0 : unit);
      for (const double y : {0.0, 0.4, 3.0, 60.0})
        for (const double z : {0.1, 2.5}) {
          CAPTURE(name(base), name(q), name(load), y, z);
          const double value = kernel(q, load, y, z);
          CHECK(kernel(q, load, -y, z) == y_sign * value);
          CHECK(kernel(q, load, y, -z) == z_sign * value);
          CHECK(scaled(q, load, y * unit, z * unit) * area == value);
          const double patch = kernel(q, load, cell, y, z);
          CHECK(kernel(q, load, cell, -y, z) == y_sign * patch);
          CHECK(kernel(q, load, cell, y, -z) == z_sign * patch);
        }
    }
}

TEST_CASE("a rectangle on a layer is the sum of its point loads", "[skin_kernel][property]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const Material material = layer(0.45, 1.0, base);
  const SkinKernel kernel(material, 1.0);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (const double width : {0.05, 0.2, 0.5, 0.9, 2.7}) {
    const Rectangle cell{width, 0.8 * width};
    for (const double y : {0.0, 0.5, 47.7})
      for (const Traction load : skin_tractions)
        for (const Quantity q : skin_quantities) {
          if (!is_defined(q, load, material)) continue;
          CAPTURE(name(base), width, y, name(q), name(load));
          // Panels end where the place lies, and where the closed form begins.
          const auto sum = [&](double from, double to) {
            return Rule::integrate(
                [&](double v) {
                  const auto row = [&](double w) { return kernel(q, load, v, 0.3 - w); };
                  return Rule::integrate(row, -0.4 * width, 0.0) +
                         Rule::integrate(row, 0.0, 0.4 * width);
                },
                from, to);
          };
          const double expected = sum(y - 0.5 * width, y) + sum(y, y + 0.5 * width);
          CHECK_THAT(
              kernel(q, load, cell, y, 0.3),
              WithinAbs(expected, kernel.error_bound(q) * std::min(1.0, width * width * 0.8)));
        }
  }
}

TEST_CASE("many places at once are as one by one in a layer too", "[skin_kernel]") {
  const SkinKernel kernel(layer(0.4, 1.0, Base::bonded), 0.5);
  const std::vector<double> y{0.0, 1.3, -2.0, 70.0};
  const std::vector<double> z{0.2, 0.0, 5.0, 1.0};
  std::vector<double> readings(y.size());
  const Rectangle cell{0.3, 0.2};
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      kernel(q, load, y, z, readings);
      for (std::size_t i = 0; i < y.size(); ++i) CHECK(readings[i] == kernel(q, load, y[i], z[i]));
      kernel(q, load, cell, y, z, readings);
      for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(readings[i] == kernel(q, load, cell, y[i], z[i]));
    }
}

TEST_CASE("what the base adds is the layer's reading less the half space's", "[skin_kernel]") {
  const std::vector<double> y{0.0, 1.3, -2.0, 70.0};
  const std::vector<double> z{0.2, 0.0, 5.0, 1.0};
  std::vector<double> readings(y.size());
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      const Material material = layer(0.4, 1.0, Base::bonded);
      const SkinKernel layer(material, 0.5);
      layer.base_part(q, load, y, z, readings);
      for (std::size_t i = 0; i < y.size(); ++i)
        CHECK_THAT(readings[i] + half_space_kernel(q, load, material, 0.5, y[i], z[i]),
                   WithinAbs(layer(q, load, y[i], z[i]), layer.error_bound(q)));
      Material half_space = material;
      half_space.layer.reset();
      SkinKernel(half_space, 0.5).base_part(q, load, y, z, readings);
      CHECK(readings == std::vector<double>(y.size()));
    }
}

TEST_CASE("a slide without end is refused, with a remedy", "[skin_kernel]") {
  const Material material = layer(0.4, 1.0, Base::frictionless);
  CHECK_THROWS_WITH(
      check_quantity(Quantity::displacement_z, Traction::tangential_y, material),
      "displacement_z under a tangential_y load is not defined in a layer on a frictionless base, "
      "which slides without end; read a stress or a strain, or bond the layer");
  CHECK_NOTHROW(check_quantity(Quantity::displacement_x, Traction::tangential_y, material));
  CHECK_NOTHROW(check_quantity(Quantity::displacement_y, Traction::normal, material));
  CHECK_NOTHROW(check_quantity(Quantity::displacement_y, Traction::tangential_y,
                               layer(0.4, 1.0, Base::bonded)));
  const SkinKernel kernel(material, 0.5);
  CHECK(std::isnan(kernel(Quantity::displacement_y, Traction::tangential_y, 0.1, 0.2)));
  CHECK(std::isnan(kernel(Quantity::displacement_y, Traction::tangential_y, 99.0, 0.2)));
  CHECK_THROWS_WITH(SkinKernel(material, 1.1),
                    "depth must be at most the layer's thickness (got 1.1)");
}
