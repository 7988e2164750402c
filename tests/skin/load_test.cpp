#include "tactile_net/skin/load.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tactile_net/skin/moving_contact.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

constexpr SkinContact contacts[] = {
    {.shape = SkinShape::sphere, .y = 0.1, .z = -0.2, .radius = 1.3, .force = 2.0},
    {.shape = SkinShape::sphere,
     .radius = 0.9,
     .force = 1.5,
     .friction = 0.5,
     .direction = 0.7,
     .stick = 0.6},
    {.shape = SkinShape::ellipsoid,
     .y = -0.3,
     .z = 0.2,
     .radius = 1.5,
     .second_radius = 0.6,
     .angle = 0.4,
     .force = 3.0,
     .friction = 0.8,
     .direction = -2.0,
     .stick = 0.3},
    {.shape = SkinShape::ellipsoid,
     .radius = 0.5,
     .second_radius = 1.1,
     .angle = 1.2,
     .force = 1.0,
     .torsion = 0.7},
    {.shape = SkinShape::punch, .y = 0.05, .radius = 0.8, .force = 2.5, .friction = -0.3},
    {.shape = SkinShape::cone,
     .z = 0.15,
     .radius = 1.1,
     .force = 1.0,
     .friction = 0.6,
     .direction = 1.0,
     .stick = 0.5},
    {.shape = SkinShape::sphere,
     .y = 0.4,
     .z = 0.3,
     .radius = 0.7,
     .force = 1.0,
     .friction = 0.2,
     .torsion = -0.5}};

/// The integral of the load's traction times `weight(y, z)`, in panels of s = sin(t) that shrink
/// towards the middle, split at what sticks.
double integral(const SkinContact& c, Traction component, const auto& weight) {
  using Rule = boost::math::quadrature::gauss<double, 40>;
  const double b = c.shape == SkinShape::ellipsoid ? c.second_radius : c.radius;
  constexpr int directions = 64;
  const auto ring = [&](double s, double inner) {
    double sum = 0.0;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2.0 * pi * i / directions;
      const double u = c.radius * s * std::cos(angle);
      const double v = b * s * std::sin(angle);
      const double y = c.y + u * std::cos(c.angle) - v * std::sin(c.angle);
      const double z = c.z + u * std::sin(c.angle) + v * std::cos(c.angle);
      sum += traction(SkinLoad(c), component, y, z) * weight(y, z);
    }
    return sum * 2.0 * pi / directions * c.radius * b * s * inner;
  };
  // Between two singular rings s = from + (to - from) sin^2 t takes both roots away.
  const auto between = [&](double from, double to) {
    return Rule::integrate(
        [&](double t) {
          const double s = from + (to - from) * std::sin(t) * std::sin(t);
          return ring(s, (to - from) * std::sin(2.0 * t));
        },
        0.0, 0.5 * pi);
  };
  const double stick = c.stick > 0.0 ? c.stick : 0.5;
  double sum = between(stick, 1.0);
  for (double to = stick; to > 1e-7; to *= 0.25) sum += between(0.25 * to, to);
  return sum;
}

}  // namespace

TEST_CASE("resultants are the tractions' integrals", "[skin]") {
  for (const SkinContact& c : contacts) {
    const SkinWrench all = resultant(SkinLoad(c));
    CAPTURE(name(c.shape), c.stick, c.torsion);
    const auto one = [](double, double) { return 1.0; };
    // A punch's rim at 1 - s = 1e-7 and less is rounded.
    const double near = c.shape == SkinShape::punch ? 1e-7 : 1e-10;
    for (std::size_t k = 0; k < 3; ++k)
      CHECK_THAT(all.force[k], WithinAbs(integral(c, skin_tractions[k], one), near));
    const auto y = [](double at, double) { return at; };
    const auto z = [](double, double at) { return at; };
    CHECK_THAT(all.moment_y, WithinAbs(integral(c, Traction::normal, y), near));
    CHECK_THAT(all.moment_z, WithinAbs(integral(c, Traction::normal, z), near));
    CHECK_THAT(all.torque, WithinAbs(integral(c, Traction::tangential_z, y) -
                                         integral(c, Traction::tangential_y, z),
                                     near));
    CHECK_THAT(all.centre().value().y, WithinAbs(c.y, 1e-15));
    CHECK_THAT(all.torsion().value(), WithinAbs(c.torsion, 1e-15));
  }
}

TEST_CASE("cells' means add up to the load, wherever their borders run", "[skin][property]") {
  for (const SkinContact& c : contacts)
    for (const double spacing : {3.0, 0.37, 0.05}) {
      const auto count = static_cast<std::size_t>(std::ceil(5.0 / spacing)) + 1;
      const SurfaceGrid grid{.rows = count,
                             .columns = count + 1,
                             .spacing_y = spacing,
                             .spacing_z = 0.9 * spacing,
                             .centre_y = 0.1 * spacing,
                             .centre_z = 0.0};
      const SkinLoad load = c;
      const std::vector<double> means = cell_means(std::span(&load, 1), grid);
      CAPTURE(name(c.shape), c.stick, c.torsion, spacing);
      const SkinWrench summed = resultant(means, grid);
      for (std::size_t k = 0; k < 3; ++k)
        CHECK_THAT(summed.force[k], WithinAbs(resultant(load).force[k], 2e-14 / spacing));
    }
}

TEST_CASE("a cell's mean is the integral over it, rims and apexes included", "[skin]") {
  // A cell against the same in many pieces, whose middles' tractions converge as their size, or
  // its square root at a punch's rim.
  for (const SkinContact& c : contacts) {
    const SurfaceGrid grid{.rows = 7, .columns = 7, .spacing_y = 0.5, .spacing_z = 0.45};
    const SkinLoad load = c;
    const std::vector<double> means = cell_means(std::span(&load, 1), grid);
    constexpr int pieces = 200;
    for (const std::size_t cell : {24u, 17u, 30u, 10u, 38u, 0u})
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0.0;
        for (int i = 0; i < pieces; ++i)
          for (int j = 0; j < pieces; ++j) {
            const double y = grid.y(cell / 7) + 0.5 * ((i + 0.5) / pieces - 0.5);
            const double z = grid.z(cell % 7) + 0.45 * ((j + 0.5) / pieces - 0.5);
            const double t = traction(load, skin_tractions[k], y, z);
            if (std::isfinite(t)) sum += t;
          }
        CAPTURE(name(c.shape), c.stick, c.torsion, cell, k);
        CHECK_THAT(means[k * grid.count() + cell],
                   WithinAbs(sum / pieces / pieces, c.shape == SkinShape::punch ? 2e-2 : 1e-4));
      }
  }
}

TEST_CASE("a cell that holds all of a load has its mean, one aside has exactly none", "[skin]") {
  for (const SkinContact& c : contacts) {
    const SurfaceGrid grid{.rows = 1, .columns = 3, .spacing_y = 8.0, .spacing_z = 8.0};
    const SkinLoad load = c;
    const std::vector<double> means = cell_means(std::span(&load, 1), grid);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK_THAT(means[3 * k + 1] * grid.area(), WithinAbs(resultant(load).force[k], 1e-14));
      CHECK(means[3 * k] == 0.0);
      CHECK(means[3 * k + 2] == 0.0);
    }
  }
}

TEST_CASE("partial slip drags nowhere more than friction allows, and less inside", "[skin]") {
  const SkinLoad load = contacts[1];
  const auto q = [&](double y) {
    return std::hypot(traction(load, Traction::tangential_y, y, 0.0),
                      traction(load, Traction::tangential_z, y, 0.0));
  };
  const auto p = [&](double y) { return traction(load, Traction::normal, y, 0.0); };
  CHECK(q(0.0) < 0.5 * p(0.0));
  CHECK_THAT(q(0.5399), WithinRel(0.5 * p(0.5399), 0.02));
  CHECK_THAT(q(0.7), WithinRel(0.5 * p(0.7), 1e-14));
  // 1 - stick^3 of a sphere's drag, Johnson 1985, 7.38.
  const SkinWrench all = resultant(load);
  CHECK_THAT(std::hypot(all.force[1], all.force[2]), WithinRel(0.75 * (1.0 - 0.216), 1e-14));
}

TEST_CASE("a circle's twist has the drag s sqrt(1 - s^2) and its torsion", "[skin]") {
  // 12 kPa s sqrt(1 - s^2) on 2.5 mm: 1.5708e-4 N m, 4 pi / 15 times 12 kPa times the radius cubed.
  const double torsion = 4.0 * pi / 15.0 * 12e3 * std::pow(2.5e-3, 3);
  CHECK_THAT(torsion, WithinRel(1.5708e-4, 1e-5));
  const SkinLoad load = SkinContact{.radius = 2.5e-3, .force = 0.1, .torsion = torsion};
  CHECK_THAT(traction(load, Traction::tangential_z, 1.5e-3, 0.0),
             WithinRel(12e3 * 0.6 * 0.8, 1e-13));
  CHECK_THAT(traction(load, Traction::tangential_y, 0.0, 1.5e-3),
             WithinRel(-12e3 * 0.6 * 0.8, 1e-13));
  CHECK(traction(load, Traction::tangential_y, 1.5e-3, 0.0) == 0.0);
}

TEST_CASE("an ellipsoid with equal radii is a sphere, a turned one has its support", "[skin]") {
  SkinContact circle{.radius = 0.7, .force = 2.0, .friction = 0.3, .stick = 0.4, .torsion = 0.1};
  SkinContact same = circle;
  same.shape = SkinShape::ellipsoid;
  same.second_radius = 0.7;
  same.angle = 1.0;
  for (const Traction k : skin_tractions)
    CHECK_THAT(traction(SkinLoad(same), k, 0.2, -0.3),
               WithinRel(traction(SkinLoad(circle), k, 0.2, -0.3), 1e-14));
  const SkinSupport box = support(SkinContact{.shape = SkinShape::ellipsoid,
                                              .y = 1.0,
                                              .radius = 3.0,
                                              .second_radius = 2.0,
                                              .angle = 0.5 * pi});
  CHECK_THAT(box.from_y, WithinAbs(-1.0, 1e-14));
  CHECK_THAT(box.to_z, WithinAbs(3.0, 1e-14));
}

TEST_CASE("a patch is uniform over its rectangles, and shared out by area", "[skin]") {
  const SampledPatch patch{.rows = 2,
                           .columns = 3,
                           .y = 1.0,
                           .z = 2.0,
                           .spacing_y = 0.5,
                           .spacing_z = 1.0,
                           .normal = {1, 2, 3, 4, 5, 6},
                           .tangential_z = {0, 0, 0, 0, 0, -1}};
  const SkinLoad load = patch;
  CHECK(traction(load, Traction::normal, 0.6, 0.6) == 1.0);
  CHECK(traction(load, Traction::normal, 1.4, 2.0) == 5.0);
  CHECK(traction(load, Traction::normal, 1.6, 2.0) == 0.0);
  CHECK(traction(load, Traction::tangential_y, 0.6, 0.6) == 0.0);
  const SkinWrench all = resultant(load);
  CHECK(all.force == std::array{10.5, 0.0, -0.5});
  CHECK_THAT(all.torque, WithinAbs(-0.5 * 1.25, 1e-15));
  CHECK_FALSE(has_traction(load, Traction::tangential_y));
  CHECK(has_traction(load, Traction::tangential_z));
  // The grid that it is a patch of gives its values back; others its force.
  const SurfaceGrid own{.rows = 2,
                        .columns = 3,
                        .spacing_y = 0.5,
                        .spacing_z = 1.0,
                        .centre_y = 1.0,
                        .centre_z = 2.0};
  const std::vector<double> means = cell_means(std::span(&load, 1), own);
  for (std::size_t i = 0; i < 6; ++i) CHECK(means[i] == patch.normal[i]);
  const SurfaceGrid other{.rows = 11,
                          .columns = 13,
                          .spacing_y = 0.31,
                          .spacing_z = 0.37,
                          .centre_y = 0.9,
                          .centre_z = 2.1};
  const SkinWrench summed = resultant(cell_means(std::span(&load, 1), other), other);
  CHECK_THAT(summed.force[0], WithinRel(10.5, 1e-14));
  CHECK_THAT(summed.force[2], WithinRel(-0.5, 1e-14));
}

TEST_CASE("units of length scale a load and nothing else", "[skin][property]") {
  const double unit = GENERATE(1e-100, 1e100);
  for (SkinContact c : contacts) {
    const SurfaceGrid grid{.rows = 5, .columns = 5, .spacing_y = 0.5, .spacing_z = 0.5};
    SurfaceGrid scaled_grid = grid;
    scaled_grid.spacing_y = scaled_grid.spacing_z = 0.5 * unit;
    const SkinLoad load = c;
    const std::vector<double> means = cell_means(std::span(&load, 1), grid);
    for (double* length : {&c.y, &c.z, &c.radius, &c.second_radius, &c.torsion}) *length *= unit;
    const SkinLoad scaled = c;
    const std::vector<double> others = cell_means(std::span(&scaled, 1), scaled_grid);
    for (std::size_t i = 0; i < means.size(); ++i)
      CHECK_THAT(others[i] * unit * unit, WithinAbs(means[i], 1e-13));
  }
}

TEST_CASE("a contact moves straight from knot to knot", "[skin]") {
  const SkinContactTrajectory path = {
      {1.0, {.y = 0.0, .radius = 1.0, .force = 0.0, .torsion = 0.5}},
      {3.0, {.y = 2.0, .radius = 2.0, .force = 4.0, .friction = 0.5, .direction = 1.0}}};
  CHECK(contact_at(path, 0.0).force == 0.0);
  CHECK(contact_at(path, 9.0).friction == 0.5);
  const SkinContact half = contact_at(path, 2.0);
  CHECK(half.y == 1.0);
  CHECK(half.radius == 1.5);
  CHECK(half.force == 2.0);
  CHECK(half.friction == 0.25);
  CHECK(half.direction == 0.5);
  CHECK(half.torsion == 0.25);
}

TEST_CASE("a load out of range is refused", "[skin]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const SkinLoad& bad : std::vector<SkinLoad>{
           SkinContact{.radius = 0.0}, SkinContact{.shape = SkinShape::ellipsoid},
           SkinContact{.second_radius = 1.0}, SkinContact{.force = infinity},
           SkinContact{.stick = 1.0}, SkinContact{.shape = SkinShape::punch, .stick = 0.5},
           SampledPatch{.rows = 1, .columns = 2, .normal = {1.0}},
           SampledPatch{.rows = 1, .columns = 1, .normal = {infinity}}})
    CHECK_THROWS_AS(check(bad), std::invalid_argument);
}
