#include "tactile_net/elasticity/space/ball_kernel.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "elasticity/space/ball_modes.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/layer.hpp"
#include "tests/elasticity/space/ball_reference.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

using Vector3 = std::array<double, 3>;

/// A frame whose x is -normal, and whose y lies as near to `along` as it can.
SurfaceFrame frame_at(const Vector3& normal, const Vector3& along) {
  const double size = std::sqrt(dot(normal, normal));
  SurfaceFrame frame;
  for (std::size_t i = 0; i < 3; ++i) frame[0][i] = -normal[i] / size;
  const double part = dot(along, frame[0]);
  for (std::size_t i = 0; i < 3; ++i) frame[1][i] = along[i] - part * frame[0][i];
  const double width = std::sqrt(dot(frame[1], frame[1]));
  for (double& value : frame[1]) value /= width;
  frame[2] = cross(frame[0], frame[1]);
  return frame;
}

/// The load's frame in these tests: at the pole, where the sensor's z is the outward normal.
const SurfaceFrame pole = frame_at({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0});

/// The outward normal at an angle from the pole, in the direction that makes `turn` with the
/// pole's y; a hole's places lie where its normals do not point.
Vector3 normal_at(double angle, double turn, double radius) {
  const double out = std::copysign(1.0, radius);
  Vector3 normal;
  for (std::size_t i = 0; i < 3; ++i)
    normal[i] = -std::cos(angle) * pole[0][i] +
                out * std::sin(angle) * (std::cos(turn) * pole[1][i] + std::sin(turn) * pole[2][i]);
  return normal;
}

/// All readings of one kind within the kernel's bound of the sums in 50 digits.
void check_digits(double nu, double radius, double depth) {
  using test::Digits;
  const Material material{.youngs_modulus = 2.0 * (1.0 + nu),  // G = 1
                          .poisson_ratio = nu,
                          .layer = Layer{1.0, Base::bonded}};
  const BallKernel kernel(material, radius, depth);
  const double size = std::abs(radius);
  std::vector<double> arcs;
  std::vector<Digits> angles;
  for (const double arc : {1e-6 * depth, 0.4 * depth, 1.7 * depth, 4.0 * depth, 3.1 * size})
    if (arc <= 3.1 * size && arc < 48.0) {
      arcs.push_back(arc);
      angles.push_back(Digits(arc) / size);
    }
  const double turn = 0.6;
  const Digits curvature = 1 / Digits(radius);
  const auto degrees = 20 + static_cast<unsigned>(60.0 / std::abs(std::log1p(-depth / radius)));
  const auto fields = test::ball_fields(Digits(nu), 1 - curvature, 1 - curvature * depth, angles,
                                        Digits(turn), degrees);
  const double cosine = std::cos(turn);
  const double sine = std::sin(turn);
  const std::array<Vector3, 3> axes = {
      {{1.0, 0.0, 0.0}, {0.0, cosine, -sine}, {0.0, sine, cosine}}};
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (const Traction load : {Traction::normal, Traction::tangential_y}) {
      const test::BallField& field =
          load == Traction::normal ? fields[i].normal : fields[i].tangential;
      std::array<Vector3, 3> stress{};
      Vector3 displacement{};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t c = 0; c < 3; ++c) {
          displacement[a] += axes[a][c] * static_cast<double>(field.displacement[c]) / 2.0 / size;
          for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t d = 0; d < 3; ++d)
              stress[a][b] +=
                  axes[a][c] * axes[b][d] * static_cast<double>(field.stress[c][d] / (size * size));
        }
      for (const Quantity q : skin_quantities) {
        const QuantityTraits& row = traits(q);
        const auto a = static_cast<std::size_t>(row.first);
        const auto b = static_cast<std::size_t>(row.second);
        double expected = row.kind == QuantityKind::displacement ? displacement[a] : stress[a][b];
        if (row.kind == QuantityKind::strain) {
          const double trace = stress[0][0] + stress[1][1] + stress[2][2];
          expected = a == b ? (stress[a][a] - nu / (1.0 + nu) * trace) / 2.0 : stress[a][b];
        }
        CAPTURE(nu, radius, depth, arcs[i], name(q), name(load));
        CHECK_THAT(kernel(q, load, arcs[i] * cosine, arcs[i] * sine),
                   WithinAbs(expected, kernel.error_bound(q)));
      }
    }
}

}  // namespace

TEST_CASE("a curved skin's readings are those of 50 digits", "[ball]") {
  struct Case {
    double nu, radius, depth;
  };
  const auto [nu, radius, depth] = GENERATE(
      Case{0.0, 2.5, 0.1}, Case{0.5, 2.5, 1.0}, Case{0.25, 7.5, 0.5}, Case{0.5, 1.0625, 0.5},
      Case{0.3, 1.0625, 1.0}, Case{0.5, -2.5, 0.1}, Case{0.0, -0.8, 1.0}, Case{0.48, -7.5, 0.5});
  check_digits(nu, radius, depth);
}

TEST_CASE("a curved skin's readings are those of 50 digits, at all radii and depths", "[long]") {
  const double nu = GENERATE(0.0, 0.48, 0.5);
  const double radius = GENERATE(2.5, 7.5, 75.0, 330.0, -2.5, -7.5, -75.0, -330.0);
  const double depth = GENERATE(0.1, 0.5, 1.0);
  if (std::abs(radius) / depth < 400.0) check_digits(nu, radius, depth);
}

TEST_CASE("a curved skin tends to a flat one as its curvature does to zero", "[ball][property]") {
  const double nu = GENERATE(0.0, 0.3, 0.5);
  const double h = 4e-3;
  const double depth = h * GENERATE(0.5, 1.0);
  const Material material = layer(nu, h, Base::bonded);
  const SkinKernel flat(material, depth);
  // All readings' departures from the flat layer's, over what it reads on the axis.
  const auto departures = [&](double radius) {
    const BallKernel kernel(material, radius, depth);
    std::vector<double> all;
    for (const Traction load : skin_tractions)
      for (const Quantity q : skin_quantities)
        for (const double r : {0.0, 0.3e-3, 2e-3, 5e-3, 20e-3}) {
          const double y = 0.8 * r;
          const double z = -0.6 * r;
          all.push_back((kernel(q, load, y, z) - flat(q, load, y, z)) /
                        (1e13 * flat.error_bound(q)));
        }
    return all;
  };
  const auto largest = [](const std::vector<double>& values) {
    double size = 0.0;
    for (const double value : values) size = std::max(size, std::abs(value));
    return size;
  };
  const double out = GENERATE(1.0, -1.0);
  CHECK(largest(departures(out * 1e6)) < 1e-8);
  const auto far = departures(out * 10.0);
  const auto near = departures(out * 1.0);    // 250 h: a sum
  const auto other = departures(out * -1.0);  // from the other side
  REQUIRE(largest(far) > 1e-5);
  for (std::size_t i = 0; i < far.size(); ++i) {
    CHECK_THAT(10.0 * far[i], WithinAbs(near[i], 0.01 * largest(near)));
    // What is left of both sides is a square of the curvature.
    CHECK_THAT(near[i] + other[i], WithinAbs(0.0, 0.04 * largest(near)));
  }
}

TEST_CASE("stresses are Hooke's law of the displacements' differences", "[ball][property]") {
  const double nu = 0.3;
  const Material material{.youngs_modulus = 2.0 * (1.0 + nu),  // G = 1
                          .poisson_ratio = nu,
                          .layer = Layer{1.0, Base::bonded}};
  const double radius = GENERATE(2.2, -2.2);
  const double size = std::abs(radius);
  const double angle = GENERATE(0.05, 0.3, 1.1);
  const double depth = 0.6;
  const Vector3 normal = normal_at(angle, 0.7, radius);
  const SurfaceFrame here = frame_at(normal, {0.3, 0.9, 0.1});
  Vector3 middle;
  for (std::size_t i = 0; i < 3; ++i)
    middle[i] = normal[i] * (radius - depth);  // of a hole: against its normal, and farther out
  const BallKernel kernel(material, radius, depth);
  const BallPlace seen = ball_place(pole, here, radius);
  // The displacement at a place of space, in the axes of `here`, under the load's three components.
  const auto displacement = [&](const Vector3& place) {
    const double distance = std::sqrt(dot(place, place));
    Vector3 outward = place;
    if (radius < 0.0)
      for (double& value : outward) value = -value;
    const SurfaceFrame there = frame_at(outward, here[1]);
    const BallKernel at(material, radius, std::abs(size - distance));
    const BallPlace from_load = ball_place(pole, there, radius);
    std::array<Vector3, 3> sum{};  // [axis][load]
    for (std::size_t a = 0; a < 3; ++a) {
      const auto part = at(std::array{Quantity::displacement_x, Quantity::displacement_y,
                                      Quantity::displacement_z}[a],
                           from_load);
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t load = 0; load < 3; ++load)
          sum[b][load] += part[load] * dot(there[a], here[b]);
    }
    return sum;
  };
  const double step = 4e-3;
  std::array<std::array<Vector3, 3>, 3> slope{};  // [axis of u][axis of the way][load]
  for (std::size_t way = 0; way < 3; ++way)
    for (const auto& [steps, weight] :
         {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
      Vector3 place = middle;
      for (std::size_t i = 0; i < 3; ++i) place[i] += steps * step * here[way][i];
      const auto u = displacement(place);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t load = 0; load < 3; ++load)
          slope[a][way][load] += weight * u[a][load] / (12.0 * step);
    }
  for (const Quantity q : skin_quantities) {
    if (traits(q).kind != QuantityKind::stress) continue;
    const auto a = static_cast<std::size_t>(traits(q).first);
    const auto b = static_cast<std::size_t>(traits(q).second);
    const auto readings = kernel(q, seen);
    for (std::size_t load = 0; load < 3; ++load) {
      const double volume = slope[0][0][load] + slope[1][1][load] + slope[2][2][load];
      const double expected = -(slope[a][b][load] + slope[b][a][load] +
                                (a == b ? 2.0 * nu / (1.0 - 2.0 * nu) * volume : 0.0));
      CAPTURE(radius, angle, name(q), load);
      CHECK_THAT(readings[load], WithinAbs(expected, 1e-7));
    }
  }
}

TEST_CASE("a sphere inside of a curved skin carries the whole load, and its moment",
          "[ball][property]") {
  const Material material = layer(GENERATE(0.0, 0.4, 0.5), 1.0, Base::bonded);
  const double radius = GENERATE(1.5, 6.0, -1.5, -6.0);
  const double depth = GENERATE(0.3, 1.0);
  const BallKernel kernel(material, radius, depth);
  const double size = std::abs(radius) - std::copysign(depth, radius);  // the sphere's
  using Rule = boost::math::quadrature::gauss<double, 30>;
  // Force and moment about the sphere's middle, of loads along the pole's x, y and z.
  std::array<std::array<double, 6>, 3> sums{};
  constexpr int rings = 40;
  constexpr int places = 8;
  for (int ring = 0; ring < rings; ++ring)
    for (std::size_t node = 0; node < Rule::abscissa().size(); ++node)
      for (const double side : {-1.0, 1.0})
        for (int i = 0; i < places; ++i) {
          // Narrow rings near the load.
          const double s = (ring + 0.5 + 0.5 * side * Rule::abscissa()[node]) / rings;
          const double angle = pi * s * s * s;
          const double weight = 0.5 * Rule::weights()[node] / rings * 3.0 * pi * s * s * 2.0 * pi /
                                places * size * size * std::sin(angle);
          const Vector3 normal = normal_at(angle, 2.0 * pi * (i + 0.5) / places, radius);
          const SurfaceFrame frame = frame_at(normal, {0.2, 0.3, 0.9});
          const BallPlace place = ball_place(pole, frame, radius);
          const std::array readings = {kernel(Quantity::stress_x, place),
                                       kernel(Quantity::shear_xy, place),
                                       kernel(Quantity::shear_xz, place)};
          Vector3 arm;
          for (std::size_t k = 0; k < 3; ++k) arm[k] = normal[k] * std::copysign(size, radius);
          for (std::size_t load = 0; load < 3; ++load) {
            Vector3 traction{};
            for (std::size_t a = 0; a < 3; ++a)
              for (std::size_t k = 0; k < 3; ++k) traction[k] += readings[a][load] * frame[a][k];
            const Vector3 moment = cross(arm, traction);
            for (std::size_t k = 0; k < 3; ++k) {
              sums[load][k] += weight * traction[k];
              sums[load][3 + k] += weight * moment[k];
            }
          }
        }
  Vector3 at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = -radius * pole[0][k];
  for (std::size_t load = 0; load < 3; ++load) {
    const Vector3 moment = cross(at, pole[load]);
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(radius, depth, material.poisson_ratio, load, k);
      CHECK_THAT(sums[load][k], WithinAbs(pole[load][k], 1e-11));
      CHECK_THAT(sums[load][3 + k], WithinAbs(moment[k], 1e-11 * std::abs(radius)));
    }
  }
}

TEST_CASE("loads all over a sphere are Lame's pressure", "[ball][property]") {
  const double nu = GENERATE(0.0, 0.4, 0.5);
  const Material material{.youngs_modulus = 2.0 * (1.0 + nu),  // G = 1
                          .poisson_ratio = nu,
                          .layer = Layer{1.0, Base::bonded}};
  const double radius = GENERATE(1.5, 6.0, -1.5, -6.0);
  const double depth = 0.4;
  const BallKernel kernel(material, radius, depth);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const auto all_over = [&](Quantity q) {
    double sum = 0.0;
    for (int ring = 0; ring < 40; ++ring)
      sum += Rule::integrate(
          [&](double s) {
            const double angle = pi * s * s * s;
            // y and z of the taxel's frame are alike.
            const double arc = angle * std::abs(radius) * std::numbers::sqrt2 / 2.0;
            return kernel(q, Traction::normal, arc, arc) * 2.0 * pi * radius * radius *
                   std::sin(angle) * 3.0 * pi * s * s;
          },
          ring / 40.0, (ring + 1) / 40.0);
    return sum;
  };
  // u_r = a r + b / r^2 with s_rr = -1 at the surface and no displacement at the core.
  const double core = radius - 1.0;
  const double place = radius - depth;
  const double ratio = std::pow(core / place, 3);
  const double rim = std::pow(core / radius, 3);
  const double m = 1.0 - 2.0 * nu;
  const double bulk = 2.0 * (1.0 + nu);
  const double scale = 1.0 / (bulk + 4.0 * m * rim);
  CHECK_THAT(all_over(Quantity::stress_x), WithinAbs((bulk + 4.0 * m * ratio) * scale, 1e-11));
  const double along = (bulk - 2.0 * m * ratio) * scale;
  CHECK_THAT(all_over(Quantity::stress_y), WithinAbs(along, 1e-11));
  CHECK_THAT(all_over(Quantity::stress_z), WithinAbs(along, 1e-11));
  CHECK_THAT(all_over(Quantity::displacement_x),
             WithinAbs(m * place * (1.0 - ratio) * scale, 1e-11));
}

TEST_CASE("the surface of a curved skin moves as Betti says", "[ball][property]") {
  // Tractions along the normal do the same work on what tangential ones cause as the other way
  // round, at each degree; both do work, and the base does not move.
  const double nu = GENERATE(0.0, 0.3, 0.5);
  const double curvature = GENERATE(0.01, 0.13, 0.9, -0.13, -2.0);
  const BallModes surface(nu, curvature, 0.0);
  const BallModes base(nu, curvature, 1.0);
  for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 10U, 100U, 1000U}) {
    CAPTURE(nu, curvature, n);
    const double c = static_cast<double>(n * (n + 1));
    const BallMode top = surface(n);
    const double size = c * std::abs(top.tangential.along);
    CHECK_THAT(top.tangential.radial, WithinAbs(c * top.normal.along, 1e-11 * size));
    CHECK_THAT(top.normal.stress, WithinRel(1.0, 1e-10));
    CHECK_THAT(top.normal.shear, WithinAbs(0.0, 1e-10));
    CHECK_THAT(top.tangential.shear, WithinRel(1.0, 1e-10));
    CHECK_THAT(top.tangential.stress, WithinAbs(0.0, 1e-8));
    CHECK_THAT(top.twist_shear, WithinRel(1.0, 1e-12));
    const double out = std::copysign(1.0, curvature);
    CHECK(out * top.normal.radial > 0.0);
    CHECK(out * top.tangential.along > 0.0);
    CHECK(out * top.twist > 0.0);
    const BallMode bottom = base(n);
    CHECK_THAT(bottom.normal.radial, WithinAbs(0.0, 1e-11 * size / static_cast<double>(n)));
    CHECK_THAT(bottom.tangential.along, WithinAbs(0.0, 1e-11 * size / c));
    CHECK(bottom.twist == 0.0);
  }
}

TEST_CASE("an incompressible curved skin is the limit of others", "[ball][property]") {
  const double radius = GENERATE(2.0, 7.5, -2.0, 400.0);
  const BallKernel kernel(layer(0.5, 1.0, Base::bonded), radius, 0.5);
  const BallKernel near(layer(0.5 - 1e-9, 1.0, Base::bonded), radius, 0.5);
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities)
      for (const double y : {0.0, 0.4, 2.0}) {
        CAPTURE(radius, name(q), name(load), y);
        CHECK_THAT(near(q, load, y, 0.3),
                   WithinAbs(kernel(q, load, y, 0.3), 1e-7 * 1e12 * kernel.error_bound(q)));
      }
}

TEST_CASE("a curved skin's kernels are even or odd, and scale, to the bit", "[ball][property]") {
  const double radius = GENERATE(3.0, -3.0);
  const BallKernel kernel(layer(0.3, 1.0, Base::bonded), radius, 0.75);
  const double unit = GENERATE(std::exp2(-300.0), std::exp2(300.0));
  const BallKernel scaled(layer(0.3, unit, Base::bonded), radius * unit, 0.75 * unit);
  const std::vector<double> y{0.0, 0.4, 3.0, 8.0};
  const std::vector<double> z{0.1, 2.5, -1.0, 4.0};
  std::vector<double> readings(y.size());
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      kernel(q, load, y, z, readings);
      const double area = unit * (traits(q).kind == QuantityKind::displacement ? 1.0 : unit);
      for (std::size_t i = 0; i < y.size(); ++i) {
        CAPTURE(name(q), name(load), y[i], z[i]);
        const double value = kernel(q, load, y[i], z[i]);
        CHECK(readings[i] == value);
        CHECK(kernel(q, load, -y[i], z[i]) == (is_odd(q, load, Axis::y) ? -value : value));
        CHECK(kernel(q, load, y[i], -z[i]) == (is_odd(q, load, Axis::z) ? -value : value));
        CHECK(scaled(q, load, y[i] * unit, z[i] * unit) * area == value);
        if (load == Traction::tangential_z)
          CHECK(value == kernel(exchanged(q), Traction::tangential_y, z[i], y[i]));
      }
    }
}

TEST_CASE("a curved skin reads up to the antipode, and nothing far away", "[ball]") {
  const Material material = layer(0.45, 1.0, Base::bonded);
  const BallKernel small(material, 2.0, 0.5);
  const double antipode = 2.0 * pi;
  CHECK(std::isfinite(small(Quantity::stress_x, Traction::normal, antipode, 0.0)));
  CHECK(std::isnan(small(Quantity::stress_x, Traction::normal, 1.001 * antipode, 0.0)));
  CHECK(std::isnan(
      small(Quantity::stress_x, Traction::normal, std::numeric_limits<double>::quiet_NaN(), 0.0)));
  // At the antipode there is no direction: what turns with it ends.
  CHECK_THAT(small(Quantity::shear_xy, Traction::normal, antipode, 0.0),
             WithinAbs(0.0, small.error_bound(Quantity::shear_xy)));
  const BallKernel large(material, 20.0, 0.5);
  for (const Quantity q : skin_quantities) {
    CHECK_THAT(large(q, Traction::normal, 47.99, 0.0), WithinAbs(0.0, large.error_bound(q)));
    CHECK(large(q, Traction::tangential_y, 33.0, 33.0) != 0.0);
    CHECK(large(q, Traction::normal, 48.01, 0.0) == 0.0);
  }
}

TEST_CASE("nothing steps where sums give way to a power series of the curvature", "[ball]") {
  const Material material = layer(0.45, 1.0, Base::bonded);
  const double depth = 0.5;
  const double out = GENERATE(1.0, -1.0);
  // A cubic through four curvatures, of which one is a sum: what is left is of fourth order.
  const std::array<double, 4> shares = {1.001, 0.999, 0.97, 0.94};
  std::vector<BallKernel> kernels;
  for (const double share : shares) kernels.emplace_back(material, out * 320.0 / share, depth);
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities)
      for (const double r : {0.0, 0.2, 1.0, 5.0, 30.0}) {
        double expected = 0.0;
        for (std::size_t i = 1; i < 4; ++i) {
          double weight = 1.0;
          for (std::size_t j = 1; j < 4; ++j)
            if (j != i) weight *= (shares[0] - shares[j]) / (shares[i] - shares[j]);
          expected += weight * kernels[i](q, load, 0.6 * r, 0.8 * r);
        }
        CAPTURE(name(q), name(load), r);
        CHECK_THAT(kernels[0](q, load, 0.6 * r, 0.8 * r),
                   WithinAbs(expected, kernels[0].error_bound(q)));
      }
}

TEST_CASE("places on a sphere are seen along the arc", "[ball]") {
  const double radius = GENERATE(0.03, -0.03);
  for (const double angle : {0.0, 1e-9, 0.4, 1.5, 3.0})
    for (const double turn : {0.0, 0.7, 3.9}) {
      CAPTURE(radius, angle, turn);
      const Vector3 normal = normal_at(angle, turn, radius);
      // The pole's frame, brought along the arc: its y keeps the angle with it.
      SurfaceFrame brought = frame_at(normal, {0.0, 0.0, 0.0});
      const double out = std::copysign(1.0, radius);
      for (std::size_t i = 0; i < 3; ++i) {
        const double outward = std::cos(turn) * pole[1][i] + std::sin(turn) * pole[2][i];
        const double across = -std::sin(turn) * pole[1][i] + std::cos(turn) * pole[2][i];
        const double along = std::cos(angle) * outward + out * std::sin(angle) * pole[0][i];
        brought[1][i] = std::cos(turn) * along - std::sin(turn) * across;
        brought[2][i] = std::sin(turn) * along + std::cos(turn) * across;
      }
      const BallPlace place = ball_place(pole, brought, radius);
      const double arc = std::abs(radius) * angle;
      CHECK_THAT(place.y, WithinAbs(arc * std::cos(turn), 1e-12 * std::abs(radius)));
      CHECK_THAT(place.z, WithinAbs(arc * std::sin(turn), 1e-12 * std::abs(radius)));
      CHECK_THAT(place.cosine, WithinAbs(1.0, 1e-12));
      CHECK_THAT(place.sine, WithinAbs(0.0, 1e-12));
      // A frame of the taxel's own turns place and load alike.
      const double own = 0.9;
      SurfaceFrame turned = brought;
      for (std::size_t i = 0; i < 3; ++i) {
        turned[1][i] = std::cos(own) * brought[1][i] + std::sin(own) * brought[2][i];
        turned[2][i] = std::cos(own) * brought[2][i] - std::sin(own) * brought[1][i];
      }
      const BallPlace other = ball_place(pole, turned, radius);
      CHECK_THAT(other.y, WithinAbs(arc * std::cos(turn - own), 1e-12 * std::abs(radius)));
      CHECK_THAT(other.z, WithinAbs(arc * std::sin(turn - own), 1e-12 * std::abs(radius)));
      CHECK_THAT(other.cosine, WithinAbs(std::cos(own), 1e-12));
      CHECK_THAT(other.sine, WithinAbs(-std::sin(own), 1e-12));
    }
}

TEST_CASE("what is no curved skin is refused, with the rule", "[ball]") {
  const Material material = layer(0.4, 4.0, Base::bonded);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(BallKernel(material, 4.0, 1.0),
                    "layer.thickness must be less than the surface's least radius of curvature, 4 "
                    "(got 4)");
  CHECK_THROWS_WITH(BallKernel(material, 3.5, 1.0),
                    "layer.thickness must be less than the surface's least radius of curvature, "
                    "3.5 (got 4)");
  CHECK_NOTHROW(BallKernel(material, 4.1, 1.0));
  CHECK_NOTHROW(BallKernel(material, -3.5, 1.0));
  CHECK_THROWS_WITH(BallKernel(material, 0.0, 1.0), "radius must not be 0 (got 0)");
  CHECK_THROWS_WITH(BallKernel(material, std::numeric_limits<double>::infinity(), 1.0),
                    "radius must be finite (got inf)");
  CHECK_THROWS_WITH(BallKernel(material, nan, 1.0), "radius must be finite (got nan)");
  CHECK_THROWS_WITH(BallKernel(material, 30.0, 0.0), "depth must be > 0 (got 0)");
  CHECK_THROWS_WITH(BallKernel(material, 30.0, 4.1),
                    "depth must be at most the layer's thickness (got 4.1)");
  CHECK_THROWS_WITH(BallKernel(material, 32.0, 0.0009),
                    "depth must be at least 1 / 16000 of the radius, or of 320 thicknesses where "
                    "that is less: 0.002 (got 9e-04)");
  CHECK_NOTHROW(BallKernel(material, 2.0 + 4.0, 0.04));
  CHECK_THROWS_WITH(BallKernel(layer(0.51, 4.0, Base::bonded), 30.0, 1.0),
                    "poisson_ratio must lie in [0, 0.5] (got 0.51)");
  const std::string rule =
      "a curved skin must be a layer that is bonded to its base: give its thickness, and no "
      "frictionless base";
  CHECK_THROWS_WITH(BallKernel(layer(0.4, 4.0, Base::frictionless), 30.0, 1.0), rule);
  CHECK_THROWS_WITH(BallKernel(Material{}, 30.0, 1.0), rule);
}
