#include "tactile_net/elasticity/space/disc.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tactile_net/elasticity/space/half_space.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

constexpr Material disc_material{.youngs_modulus = 1.0, .poisson_ratio = 0.3};

/// The disc's point loads summed, with r = a sin(angle), which takes the profiles' edge away.
double summed(Quantity q, Traction load, const Disc& disc, double x, double y, double z) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  using Short = boost::math::quadrature::gauss<double, 20>;
  const double a = disc.radius;
  constexpr int directions = 128;
  const auto ring = [&](double r) {
    double sum = 0.0;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2.0 * pi * (i + 0.5) / directions;
      sum += half_space_kernel(q, load, disc_material, x, y - r * std::cos(angle),
                               z - r * std::sin(angle));
    }
    return sum * 2.0 * pi / directions * r;
  };
  const auto at_angle = [&](double angle) {
    const double r = a * std::sin(angle);
    return ring(r) * traction(disc, r) * a * std::cos(angle);
  };
  if (disc.profile != DiscProfile::cone) return Rule::integrate(at_angle, 0.0, 0.5 * pi);
  // Panels that shrink towards the apex, whose logarithm r tames.
  double sum = 0.0;
  for (double from = 0.25 * pi, to = 0.5 * pi; to > 1e-8; to = from, from *= 0.5)
    sum += Short::integrate(at_angle, from, to);
  return sum;
}

}  // namespace

TEST_CASE("a disc's traction carries its force", "[disc]") {
  using Rule = boost::math::quadrature::gauss<double, 40>;
  for (const DiscProfile profile : {DiscProfile::sphere, DiscProfile::punch, DiscProfile::cone}) {
    const Disc disc{profile, 0.7, 3.0};
    double sum = 0.0;
    for (double from = 0.25 * pi, to = 0.5 * pi; to > 1e-9; to = from, from *= 0.5)
      sum += Rule::integrate(
          [&](double angle) {
            const double r = 0.7 * std::sin(angle);
            return 2.0 * pi * r * traction(disc, r) * 0.7 * std::cos(angle);
          },
          from, to);
    CHECK_THAT(sum, WithinRel(3.0, 1e-12));
    CHECK(traction(disc, 0.71) == 0.0);
  }
  CHECK(std::isinf(traction({DiscProfile::punch}, 1.0)));
  CHECK(std::isinf(traction({DiscProfile::cone}, 0.0)));
}

TEST_CASE("a disc's field is the sum of its point loads, pushed and dragged", "[disc]") {
  const auto profile = GENERATE(DiscProfile::sphere, DiscProfile::punch, DiscProfile::cone);
  const Disc disc{profile, 1.3, 2.0};
  struct Place {
    double x, y, z;
  };
  for (const Place& p : {Place{0.9, 0.0, 0.0}, Place{0.7, 0.5, -0.2}, Place{1.0, 1.3, 0.0},
                         Place{0.8, 2.0, 1.0}, Place{4.0, -3.0, 7.0}})
    for (const Traction load : {Traction::normal, Traction::tangential_y}) {
      double largest[3] = {};
      for (const Quantity q : skin_quantities) {
        double& l = largest[static_cast<int>(traits(q).kind)];
        l = std::max(l, std::abs(disc_reading(q, load, disc_material, disc, p.x, p.y, p.z)));
      }
      for (const Quantity q : skin_quantities) {
        CAPTURE(static_cast<int>(profile), p.x, p.y, p.z, name(load), name(q));
        CHECK_THAT(disc_reading(q, load, disc_material, disc, p.x, p.y, p.z),
                   WithinAbs(summed(q, load, disc, p.x, p.y, p.z),
                             2e-13 * largest[static_cast<int>(traits(q).kind)] + 1e-18));
      }
    }
}

TEST_CASE("under a sphere the stresses on the axis are Huber's", "[disc]") {
  // Johnson 1985, 3.45.
  const double a = 0.4;
  const double force = 5.0;
  const double peak = 1.5 * force / (pi * a * a);
  const double nu = disc_material.poisson_ratio;
  const Disc disc{DiscProfile::sphere, a, force};
  for (const double x : {0.0004, 0.004, 0.04, 0.3, 1.0, 50.0}) {
    const double s = x / a;
    const double tiny = 4e-15 * std::max(1.0, 1.0 / (s * s));
    const double down = 1.0 / (1.0 + s * s);
    CAPTURE(x);
    CHECK_THAT(disc_reading(Quantity::stress_x, Traction::normal, disc_material, disc, x, 0.0, 0.0),
               WithinAbs(peak * down, tiny * peak));
    // 1 - s atan(1 / s) cancels far below.
    CHECK_THAT(
        disc_reading(Quantity::stress_z, Traction::normal, disc_material, disc, x, 0.0, 0.0),
        WithinAbs(peak * ((1.0 + nu) * (1.0 - s * std::atan(1.0 / s)) - 0.5 * down), tiny * peak));
  }
}

TEST_CASE("just below the surface a disc's stresses are its traction", "[disc]") {
  for (const double r : {0.0, 0.3, 0.8, 1.2})
    for (const Traction load : skin_tractions) {
      const Disc disc{DiscProfile::sphere, 1.0, 1.0};
      const Quantity own = load == Traction::normal         ? Quantity::stress_x
                           : load == Traction::tangential_y ? Quantity::shear_xy
                                                            : Quantity::shear_xz;
      const auto at = [&](double x) {
        return disc_reading(own, load, disc_material, disc, x, r, 0.0);
      };
      CAPTURE(r, name(load));
      // A drag's stress changes with the depth at once: extrapolated to the surface.
      CHECK_THAT(2.0 * at(0.0005) - at(0.001), WithinAbs(traction(disc, r), 2e-5));
    }
}

TEST_CASE("far below a disc is a point load", "[disc][property]") {
  for (const DiscProfile profile : {DiscProfile::sphere, DiscProfile::punch, DiscProfile::cone})
    for (const Traction load : skin_tractions)
      for (const Quantity q : skin_quantities) {
        const double point = half_space_kernel(q, load, disc_material, 1e6, 3e5, -4e5);
        CHECK_THAT(disc_reading(q, load, disc_material, {profile}, 1e6, 3e5, -4e5),
                   WithinAbs(point, 1e-10 * std::abs(point)));
      }
}

TEST_CASE("units of length scale a disc and nothing else", "[disc][property]") {
  const double unit = GENERATE(1e-150, 1e150);
  const Disc disc{DiscProfile::sphere, 1.0, 1.0};
  const Disc scaled{DiscProfile::sphere, unit, 1.0};
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      const double area = unit * (traits(q).kind == QuantityKind::displacement ? 1.0 : unit);
      CHECK_THAT(
          disc_reading(q, load, disc_material, scaled, 0.5 * unit, 0.25 * unit, -0.75 * unit) *
              area,
          WithinRel(disc_reading(q, load, disc_material, disc, 0.5, 0.25, -0.75), 1e-12));
    }
}

TEST_CASE("a disc without a radius is refused", "[disc]") {
  CHECK_THROWS_WITH(check(Disc{DiscProfile::sphere, 0.0, 1.0}), "radius must be > 0 (got 0)");
  CHECK_THROWS_WITH(check(Disc{DiscProfile::cone, 1.0, std::numeric_limits<double>::infinity()}),
                    "force must be finite (got inf)");
  CHECK_NOTHROW(check(Disc{DiscProfile::punch, 1.0, -2.0}));
}
