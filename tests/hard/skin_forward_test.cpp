// Skins at their limits: exact readings keep their 1e-10, against sums in 100 digits and waves.
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/spectral.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/space/reference.hpp"

using namespace tactile_net;
using test::Tensor;
using test::Vector;

namespace {

const std::vector<Quantity> all_quantities(skin_quantities.begin(), skin_quantities.end());

constexpr SkinContact twisted{.shape = SkinShape::ellipsoid,
                              .y = 0.2,
                              .z = -0.1,
                              .radius = 1.3,
                              .second_radius = 0.8,
                              .angle = 0.5,
                              .force = 2.0,
                              .friction = 0.4,
                              .direction = -0.6,
                              .torsion = 0.5};

std::vector<double> at(const SkinLoad& load, const Material& material, double depth, double y,
                       double z, const std::vector<Quantity>& reads = all_quantities) {
  return exact_readings(uneven_skin({{"", y, z, depth, reads}}), material, std::span(&load, 1));
}

/// Largest difference over the largest reading of its kind.
double error(const std::vector<double>& found, const std::vector<double>& expected) {
  std::array<double, 3> largest{};
  std::array<double, 3> worst{};
  for (std::size_t q = 0; q < expected.size(); ++q) {
    const auto kind = static_cast<std::size_t>(traits(skin_quantities[q]).kind);
    largest[kind] = std::max(largest[kind], std::abs(expected[q]));
    const double difference = std::abs(found[q] - expected[q]);
    worst[kind] = std::isfinite(difference) ? std::max(worst[kind], difference) : INFINITY;
  }
  double result = 0.0;
  for (std::size_t kind = 0; kind < 3; ++kind)
    if (worst[kind] > 0.0) result = std::max(result, worst[kind] / largest[kind]);
  return result;
}

/// Point loads by their displacements in textbooks, in 100 digits, summed over the ellipse.
std::vector<double> summed(const SkinContact& c, const test::Real& nu, double x, double y,
                           double z) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  constexpr int directions = 64;
  std::array<Vector, 3> u{};
  std::array<Tensor, 3> s{};
  Vector displacement{};
  Tensor stress{};
  const auto add = [&](double t, double weight) {
    for (int i = 0; i < directions; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / directions;
      const double a = c.radius * std::sin(t) * std::cos(angle);
      const double b = c.second_radius * std::sin(t) * std::sin(angle);
      const double dy = a * std::cos(c.angle) - b * std::sin(c.angle);
      const double dz = a * std::sin(c.angle) + b * std::cos(c.angle);
      const double turn =
          5.0 * c.torsion / (c.radius * c.radius + c.second_radius * c.second_radius);
      const std::array force = {c.force, c.friction * c.force * std::cos(c.direction) - turn * dz,
                                c.friction * c.force * std::sin(c.direction) + turn * dy};
      const Vector place = {test::Real(x), test::Real(y) - c.y - dy, test::Real(z) - c.z - dz};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto moved = [&](const Vector& p) {
          return test::textbook_displacement(axis(skin_tractions[k]), nu, p);
        };
        u[k] = moved(place);
        s[k] = test::stress_of(moved, nu, place);
        const test::Real share = test::Real(force[k]) * weight / directions;
        for (std::size_t i1 = 0; i1 < 3; ++i1) {
          displacement[i1] += share * u[k][i1];
          for (std::size_t i2 = 0; i2 < 3; ++i2) stress[i1][i2] += share * s[k][i1][i2];
        }
      }
    }
  };
  // The share of a sphere's force on the ring sin t: 3 cos^2 t sin t dt.
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      const double t = 0.25 * std::numbers::pi * (1.0 + side * Rule::abscissa()[i]);
      add(t, 0.25 * std::numbers::pi * Rule::weights()[i] * 3.0 * std::cos(t) * std::cos(t) *
                 std::sin(t));
    }
  std::vector<double> readings;
  for (const QuantityTraits& row : quantity_traits) {
    const auto a = static_cast<std::size_t>(row.first);
    const auto b = static_cast<std::size_t>(row.second);
    test::Real value = row.kind == QuantityKind::displacement ? displacement[a] : stress[a][b];
    if (row.kind == QuantityKind::strain)
      value = a == b ? (1 + nu) * value - nu * (stress[0][0] + stress[1][1] + stress[2][2])
                     : 2 * (1 + nu) * value;
    readings.push_back(static_cast<double>(value));
  }
  return readings;
}

}  // namespace

TEST_CASE("ellipses on a half space keep their digits: nu 0 and 1/2, in a corner and beyond",
          "[hard]") {
  struct Place {
    double nu, x, y, z;
  };
  for (const Place& p : {Place{0.0, 1.0, 0.2, -0.1}, Place{0.5, 0.9, 1.2, 0.9},
                         Place{0.5, 1.1, -40.0, 55.0}, Place{0.0, 300.0, 5.0, -2.0}}) {
    const test::Real nu = p.nu == 0.5 ? test::Real(0.5) - test::Real("1e-35") : test::Real(p.nu);
    CAPTURE(p.nu, p.x, p.y, p.z);
    CHECK(error(at(twisted, {.youngs_modulus = 1.0, .poisson_ratio = p.nu}, p.x, p.y, p.z),
                summed(twisted, nu, p.x, p.y, p.z)) < 1e-10);
  }
}

TEST_CASE("contacts on thin layers keep their digits, at the base too", "[hard]") {
  // Sums of waves as in tests/skin/exact_test.cpp, with 500 directions, of `slipping`.
  SkinContact slipping = twisted;
  slipping.stick = 0.6;
  const std::vector<double> base = {0.6296481413608469,
                                    0.20085533827117627,
                                    0.18004966510052015,
                                    0.0,
                                    0.0,
                                    0.11261217609586786,
                                    0.43919563967499864,
                                    -0.20399356495950727,
                                    -0.23520207471549143,
                                    0.0,
                                    0.0,
                                    0.33783652828760363};
  const std::vector<double> inside = {
      0.6369931727825526,  -0.029727067461982077, 0.03466599665423764,  0.2798142732290289,
      -0.2704480182256016, -0.010963188648978224, 0.6369931727825526,   -0.029727067461982077,
      0.03466599665423764, 0.5596285464580578,    -0.5408960364512032,  -0.021926377297956448,
      0.03182605497940103, 0.028425153934564323,  -0.026065429937165183};
  const auto layer = [](double nu, Base kind) {
    return Material{.youngs_modulus = 1.0, .poisson_ratio = nu, .layer = Layer{0.25, kind}};
  };
  // Nothing moves down there; aside there is no displacement to speak of.
  const std::vector<Quantity> defined(all_quantities.begin(), all_quantities.begin() + 12);
  CHECK(error(at(slipping, layer(0.5, Base::frictionless), 0.25, 0.9, 0.5, defined), base) < 1e-10);
  CHECK(error(at(slipping, layer(0.0, Base::bonded), 0.2, -0.5, -0.7), inside) < 1e-10);
}

TEST_CASE("units of any size scale exact and sampled readings and nothing else", "[hard]") {
  const SkinContact contacts[] = {
      twisted,
      {.y = 0.1, .radius = 0.9, .force = 1.5, .friction = 0.3, .stick = 0.5},
      {.shape = SkinShape::cone, .radius = 0.7, .force = -1.0, .torsion = 0.1},
      {.shape = SkinShape::punch, .z = 0.3, .radius = 0.6, .friction = 1.0}};
  const SkinArray skin{.rows = 1,
                       .columns = 3,
                       .pitch_y = 0.0,
                       .pitch_z = 0.7,
                       .depths = {0.6},
                       .reads = {Quantity::stress_x, Quantity::strain_y, Quantity::displacement_z}};
  for (const double unit : {1e-150, 1e-30, 1e30, 1e150})
    for (const bool has_base : {false, true}) {
      Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
      if (has_base) material.layer = Layer{1.1, Base::bonded};
      SkinArray scaled = skin;
      scaled.pitch_z *= unit;
      scaled.depths[0] *= unit;
      Material other = material;
      if (has_base) other.layer->thickness *= unit;
      for (const SkinContact& contact : contacts) {
        SkinContact large = contact;
        for (double* length :
             {&large.y, &large.z, &large.radius, &large.second_radius, &large.torsion})
          *length *= unit;
        const SkinLoad load = contact;
        const SkinLoad large_load = large;
        const auto check = [&](const std::vector<double>& one, const std::vector<double>& two) {
          std::vector<double> rescaled = two;
          for (std::size_t i = 0; i < two.size(); ++i) rescaled[i] *= i < 6 ? unit * unit : unit;
          // A kind each: stress, strain, displacement.
          for (std::size_t q = 0; q < 3; ++q) {
            double largest = 0.0;
            for (std::size_t i = 3 * q; i < 3 * q + 3; ++i)
              largest = std::max(largest, std::abs(one[i]));
            for (std::size_t i = 3 * q; i < 3 * q + 3; ++i)
              CHECK(std::abs(rescaled[i] - one[i]) <= 1e-11 * largest);
          }
        };
        CAPTURE(unit, has_base, name(contact.shape));
        check(exact_readings(skin, material, std::span(&load, 1)),
              exact_readings(scaled, other, std::span(&large_load, 1)));
        const SurfaceGrid grid = grid_of(skin);
        const SurfaceGrid large_grid = grid_of(scaled);
        const auto cells = cell_means(std::span(&load, 1), grid);
        const auto large_cells = cell_means(std::span(&large_load, 1), large_grid);
        check(sampled_readings(skin, material, grid, cells),
              sampled_readings(scaled, other, large_grid, large_cells));
        check(sampled_readings(skin, material, grid, cells),
              SpectralSkinModel(scaled, other, large_grid).readings(large_cells));
      }
    }
}

TEST_CASE("one row, one column and one taxel read what they do among others", "[hard]") {
  const Material material{.poisson_ratio = 0.5, .layer = Layer{1.0, Base::frictionless}};
  const SkinArray skin{.rows = 3,
                       .columns = 3,
                       .pitch_y = 0.5,
                       .pitch_z = 0.8,
                       .depths = {1.0},
                       .reads = {Quantity::stress_y}};
  // In the corner, half of it beyond.
  SkinContact corner = twisted;
  corner.y = 0.5;
  corner.z = 0.8;
  const SkinLoad load = corner;
  const auto all = exact_readings(skin, material, std::span(&load, 1));
  SkinArray part = skin;
  part.rows = 1;
  const auto row = exact_readings(part, material, std::span(&load, 1));
  for (std::size_t i = 0; i < 3; ++i) CHECK(row[i] == all[3 + i]);
  part.columns = 1;
  CHECK(exact_readings(part, material, std::span(&load, 1))[0] == all[4]);
  part.rows = 3;
  const auto column = exact_readings(part, material, std::span(&load, 1));
  for (std::size_t i = 0; i < 3; ++i) CHECK(column[i] == all[3 * i + 1]);
}
