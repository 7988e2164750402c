#include "tactile_net/elasticity/space/half_space.hpp"

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/space/place.hpp"
#include "tests/elasticity/space/reference.hpp"

using namespace tactile_net;
using namespace tactile_net::test;
using std::numbers::pi;

namespace {

using SurfaceRule = boost::math::quadrature::gauss_kronrod<double, 61>;

constexpr Material half_space_material{.youngs_modulus = 1.0, .poisson_ratio = 0.3125};

Material of(double nu) { return {.youngs_modulus = 1.0, .poisson_ratio = nu}; }

/// On the axis, near the surface, deep, far along each axis and across.
constexpr std::array<Place, 9> places = {{{1.0, 0.0, 0.0},
                                          {1.0, 0.7, -0.4},
                                          {0.5, 0.0, 2.0},
                                          {0.01, 0.3, 0.8},
                                          {1.0, 1e-9, 0.0},
                                          {30.0, -2.0, 1.0},
                                          {1.0, 40.0, 0.0},
                                          {1.0, 25.0, -60.0},
                                          {1e-6, 3.0, 4.0}}};

}  // namespace

TEST_CASE("displacements are the textbook's, stresses Hooke's law of them, to rounding",
          "[half_space]") {
  const double nu = GENERATE(0.0, 0.25, 0.5);
  for (const Place& p : places)
    for (const Traction load : skin_tractions) {
      const Vector place{p.x, p.y, p.z};
      // As near to an incompressible skin as the digits can tell.
      const Real exact_nu = nu == 0.5 ? Real(0.5) - Real("1e-35") : Real(nu);
      const auto displacement = [&](const Vector& at) {
        return textbook_displacement(axis(load), exact_nu, at);
      };
      const Vector u = displacement(place);
      const Tensor s = stress_of(displacement, exact_nu, place);
      Real trace = s[0][0] + s[1][1] + s[2][2];
      double largest[3] = {};
      for (const auto kind :
           {QuantityKind::stress, QuantityKind::strain, QuantityKind::displacement})
        largest[static_cast<int>(kind)] = largest_of(of(nu), load, p, kind);
      largest[1] = largest[0];  // E = 1: a strain is as exact as the stresses it is made of
      for (const Quantity q : skin_quantities) {
        CAPTURE(nu, p.x, p.y, p.z, name(q), name(load));
        const auto& [value, text, unit, kind, first, second] = traits(q);
        const auto a = static_cast<std::size_t>(first);
        const auto b = static_cast<std::size_t>(second);
        const Real expected = kind == QuantityKind::displacement ? u[a]
                              : kind == QuantityKind::stress     ? s[a][b]
                              : a != b                           ? 2 * (1 + exact_nu) * s[a][b]
                                       : s[a][a] - exact_nu * (trace - s[a][a]);
        const double actual = half_space_kernel(q, load, of(nu), p.x, p.y, p.z);
        CHECK(std::abs((actual - expected).convert_to<double>()) <=
              3e-15 * largest[static_cast<int>(kind)] +
                  1e-25);  // beside which differences are not 0
      }
    }
}

TEST_CASE("the stresses under a point load balance", "[half_space][property]") {
  const double nu = GENERATE(0.0, 0.25, 0.4375);
  for (const Traction load : skin_tractions) {
    const auto stress = [&](const Vector& at) {
      return stress_of(
          [&](const Vector& there) { return textbook_displacement(axis(load), nu, there); }, nu,
          at);
    };
    // The reference itself: its stresses, which the kernels equal, have no divergence.
    const Vector place{Real(1.25), Real(0.75), Real(-0.5)};
    const Real step("1e-6");
    for (std::size_t a = 0; a < 3; ++a) {
      Real divergence = 0;
      for (std::size_t b = 0; b < 3; ++b) {
        Vector ahead = place;
        Vector behind = place;
        ahead[b] += step;
        behind[b] -= step;
        divergence += (stress(ahead)[a][b] - stress(behind)[a][b]) / (2 * step);
      }
      CHECK(abs(divergence) < Real("1e-11"));
    }
  }
}

TEST_CASE("every plane below carries the whole load, and no other", "[half_space][property]") {
  const double depth = GENERATE(1e-3, 1.0, 50.0);
  const std::array across_plane = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz};
  for (const Traction load : skin_tractions)
    for (const Quantity q : across_plane) {
      // r = depth tan t; eight directions integrate the orders 0 to 2 in the angle exactly.
      const double sum = SurfaceRule::integrate(
          [&](double t) {
            const double r = depth * std::tan(t);
            double ring = 0.0;
            for (int i = 0; i < 8; ++i)
              ring += half_space_kernel(q, load, half_space_material, depth,
                                        r * std::cos(pi * (i + 0.5) / 4.0),
                                        r * std::sin(pi * (i + 0.5) / 4.0));
            return ring * pi / 4.0 * r * depth / (std::cos(t) * std::cos(t));
          },
          0.0, 0.5 * pi, 0, 0.0);
      CAPTURE(name(load), name(q), depth);
      CHECK_THAT(sum,
                 WithinAbs(static_cast<int>(load) == static_cast<int>(traits(q).second), 1e-13));
    }
}

TEST_CASE("a skin's kernels are even or odd, to the bit", "[half_space][property]") {
  const Rectangle cell{0.8, 0.5};
  for (const Quantity q : skin_quantities)
    for (const Traction load : skin_tractions)
      for (const Place& p : places) {
        CAPTURE(name(q), name(load), p.x, p.y, p.z);
        const double y_sign = is_odd(q, load, Axis::y) ? -1.0 : 1.0;
        const double z_sign = is_odd(q, load, Axis::z) ? -1.0 : 1.0;
        const double point = half_space_kernel(q, load, half_space_material, p.x, p.y, p.z);
        CHECK(half_space_kernel(q, load, half_space_material, p.x, -p.y, p.z) == y_sign * point);
        CHECK(half_space_kernel(q, load, half_space_material, p.x, p.y, -p.z) == z_sign * point);
        const double patch = half_space_kernel(q, load, half_space_material, cell, p.x, p.y, p.z);
        CHECK(half_space_kernel(q, load, half_space_material, cell, p.x, -p.y, p.z) ==
              y_sign * patch);
        CHECK(half_space_kernel(q, load, half_space_material, cell, p.x, p.y, -p.z) ==
              z_sign * patch);
      }
}

TEST_CASE("an incompressible skin is compressed along the rays from the load alone",
          "[half_space][property]") {
  // 3 cos(angle between ray and load) / (2 pi R^2), and no volume changes.
  const Material rubber = of(0.5);
  for (const Traction load : skin_tractions)
    for (const Place& p : places) {
      const auto at = [&](Quantity q) { return half_space_kernel(q, load, rubber, p.x, p.y, p.z); };
      const double along = load == Traction::normal         ? p.x
                           : load == Traction::tangential_y ? p.y
                                                            : p.z;
      const double r = std::hypot(p.x, p.y, p.z);
      const double expected = 1.5 / pi * along / r / (r * r);
      const double trace = at(Quantity::stress_x) + at(Quantity::stress_y) + at(Quantity::stress_z);
      CHECK_THAT(trace, WithinAbs(expected, 4e-15 * std::abs(expected)));
      CHECK_THAT(at(Quantity::strain_x) + at(Quantity::strain_y) + at(Quantity::strain_z),
                 WithinAbs(0.0, 4e-15 * std::abs(expected)));
    }
}

TEST_CASE("many places at once are as one by one", "[half_space]") {
  std::vector<double> y, z;
  for (int i = 0; i < 37; ++i) {
    y.push_back(0.3 * i - 4.0);
    z.push_back(2.0 - 0.17 * i);
  }
  std::vector<double> readings(y.size());
  const Rectangle cell{0.8, 0.5};
  for (const Quantity q : skin_quantities)
    for (const Traction load : skin_tractions) {
      half_space_kernel(q, load, half_space_material, 0.9, y, z, readings);
      for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(readings[i] == half_space_kernel(q, load, half_space_material, 0.9, y[i], z[i]));
      half_space_kernel(q, load, half_space_material, cell, 0.9, y, z, readings);
      for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(readings[i] ==
              half_space_kernel(q, load, half_space_material, cell, 0.9, y[i], z[i]));
    }
}

TEST_CASE("units of length and modulus scale a skin's kernels and nothing else",
          "[half_space][property]") {
  const double unit = GENERATE(1e-150, 1e-3, 1e150);
  const Material soft{.youngs_modulus = 2e-5, .poisson_ratio = half_space_material.poisson_ratio};
  const Rectangle cell{0.8, 0.5};
  const Rectangle scaled{0.8 * unit, 0.5 * unit};
  for (const Quantity q : skin_quantities)
    for (const Traction load : skin_tractions)
      for (const Place& p : places) {
        const QuantityKind kind = traits(q).kind;
        const double e = kind == QuantityKind::stress ? 1.0 : 2e-5;
        const double length = kind == QuantityKind::displacement ? 1.0 / unit : 1.0;
        const double tiny = 1e-13 * largest_of(half_space_material, load, p, kind);
        CAPTURE(unit, name(q), name(load), p.x, p.y, p.z);
        CHECK_THAT(half_space_kernel(q, load, soft, p.x * unit, p.y * unit, p.z * unit) * unit *
                       unit * e * length,
                   WithinAbs(half_space_kernel(q, load, half_space_material, p.x, p.y, p.z), tiny));
        CHECK_THAT(half_space_kernel(q, load, soft, scaled, p.x * unit, p.y * unit, p.z * unit) *
                       e * length,
                   WithinAbs(half_space_kernel(q, load, half_space_material, cell, p.x, p.y, p.z),
                             1e-13 * largest_of(half_space_material, load, p, kind, cell)));
      }
}

TEST_CASE("at a distance of 1e160 depths nothing is left, and no NaN", "[half_space]") {
  for (const Quantity q : skin_quantities)
    for (const Traction load : skin_tractions)
      CHECK(half_space_kernel(q, load, half_space_material, 1.0, 1e160, -1e160) == 0.0);
}
