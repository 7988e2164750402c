// Curved skins: charts, cells, sums, and the flat skin as their limit.
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tactile_net/skin/space_wrench.hpp"
#include "tests/catch.hpp"
#include "tests/skin/curved_skins.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// Columns: where the sensor's axes point.
struct Turn {
  std::array<SpaceVector, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  SpaceVector shift{};

  [[nodiscard]] SpaceVector direction(const SpaceVector& v) const {
    return combined(1.0, combined(v[0], axes[0], v[1], axes[1]), v[2], axes[2]);
  }
  [[nodiscard]] SpaceVector place(const SpaceVector& p) const {
    return combined(1.0, direction(p), 1.0, shift);
  }
};

/// By Rodrigues' formula.
Turn turn_about(const SpaceVector& axis, double angle, const SpaceVector& shift) {
  const SpaceVector n = multiple(1.0 / length(axis), axis);
  Turn turn{.shift = shift};
  for (SpaceVector& e : turn.axes)
    e = combined(1.0, combined(std::cos(angle), e, std::sin(angle), cross(n, e)),
                 (1.0 - std::cos(angle)) * dot(n, e), n);
  return turn;
}

/// Smooth tractions that are not 0 anywhere.
std::vector<double> some_tractions(const LinearProblem& problem) {
  std::vector<double> all(problem.components * problem.grid.count());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = 1e3 * (1.3 + std::sin(0.37 * static_cast<double>(i)));
  return all;
}

}  // namespace

TEST_CASE("a chart's places are on the sphere, its areas the sphere's, and it inverts itself",
          "[skin][curved][property]") {
  const double radius = GENERATE(7e-3, -12e-3, 1.0, 1e5);
  const SpaceVector outward = {0.6, 0.0, 0.8};
  const CurvedSurface surface({1e-3, 2e-3, 3e-3}, outward, 1.0 / radius, {0.1, 1.0, 0.2});
  const SpaceVector centre = combined(1.0, {1e-3, 2e-3, 3e-3}, -radius, outward);
  for (const double y : {0.0, 3e-3, -5e-3})
    for (const double z : {0.0, 1e-3, 6e-3}) {
      CAPTURE(radius, y, z);
      const SurfacePlace place = surface.at(y, z);
      const double off = length(combined(1.0, place.point, -1.0, centre)) - std::abs(radius);
      CHECK(std::abs(off) <= 4e-16 * (std::abs(radius) + 1e-2));
      const SpaceVector normal = combined(1.0 / radius, place.point, -1.0 / radius, centre);
      CHECK(length(combined(1.0, normal, 1.0, place.frame[0])) <= 1e-14 + 1e-17 / 1e-3);
      CHECK(std::abs(place.stretch - 1.0) <= 1e-14);
      CHECK(place.mean_curvature == 1.0 / radius);
      const auto back = surface.chart(combined(1.0, place.point, -0.4e-3, place.frame[0]));
      CHECK(std::abs(back.y - y) <= 1e-16);
      CHECK(std::abs(back.z - z) <= 1e-16);
      CHECK(std::abs(back.outside - 0.4e-3) <= 1e-16);
    }
}

TEST_CASE("under an even pressure a patch of any surface bears its rim's area vector",
          "[skin][curved][property]") {
  const auto frames = GENERATE(SurfaceFrames::tangent, SurfaceFrames::carried);
  const bool ends = GENERATE(false, true);
  const CurvedSurface sphere =
      CurvedSurface({0, 0, 14e-3}, {0, 0, 1}, 1.0 / 20e-3, {0, 1, 0}, frames)
          .raised({.degree = 3,
                   .length = 8e-3,
                   .coefficients = {0, 1e-4, -2e-4, 8e-4, 3e-4, -5e-4, 1e-4, 0, 2e-4, -1e-4},
                   .end_y = ends ? 4e-3 : 1.0,
                   .end_z = ends ? 3e-3 : 1.0});
  const SurfaceGrid grid{.rows = 14, .columns = 11, .spacing_y = 0.8e-3, .spacing_z = 0.9e-3};
  SpaceVector force{};
  for (const SurfaceCell& cell : sphere.cells(grid))
    force = combined(1.0, force, 1.0, cell.force[0]);
  // 1/2 of the integral of r x dr along the rim, by Gauss' rule on many pieces of each side.
  SpaceVector area{};
  const double half_y = 0.5 * grid.spacing_y * static_cast<double>(grid.rows);
  const double half_z = 0.5 * grid.spacing_z * static_cast<double>(grid.columns);
  const auto side = [&](double from_y, double from_z, double to_y, double to_z) {
    constexpr int pieces = 400;
    for (int i = 0; i < pieces; ++i)
      for (const double node : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
        const double t = (i + node) / pieces;
        const auto at = sphere.tangents(from_y + t * (to_y - from_y), from_z + t * (to_z - from_z));
        const SpaceVector along =
            combined((to_y - from_y) / pieces, at.along_y, (to_z - from_z) / pieces, at.along_z);
        area = combined(1.0, area, 0.25, cross(at.point, along));
      }
  };
  side(-half_y, -half_z, half_y, -half_z);
  side(half_y, -half_z, half_y, half_z);
  side(half_y, half_z, -half_y, half_z);
  side(-half_y, half_z, -half_y, -half_z);
  // y, then z is clockwise from outside: the vector points inward, as pressure does.
  // Cells that the ellipse's edge crosses bend in their middle.
  CHECK(length(combined(1.0, force, -1.0, area)) <= (ends ? 1e-5 : 1e-8) * length(area));
}

TEST_CASE("a height goes on straight beyond its ellipse, without a step or a crease",
          "[skin][curved][property]") {
  const HeightField inside{
      .degree = 3,
      .length = 8e-3,
      .coefficients = {1e-4, 1e-4, -2e-4, 8e-4, 3e-4, -5e-4, 1e-4, 2e-4, 3e-4, -1e-4}};
  HeightField field = inside;
  field.end_y = 4e-3;
  field.end_z = 3e-3;
  for (const double turn : {0.2, 1.3, 2.9, 4.4}) {
    CAPTURE(turn);
    const auto at = [&](double outward) {
      return field.at(4e-3 * outward * std::cos(turn), 3e-3 * outward * std::sin(turn));
    };
    const auto edge = at(1.0);
    const auto same = inside.at(4e-3 * std::cos(turn), 3e-3 * std::sin(turn));
    CHECK(edge.height == same.height);
    const auto beyond = at(1.0 + 1e-9);
    CHECK(std::abs(beyond.slope_y - same.slope_y) <= 1e-8);
    CHECK(std::abs(beyond.slope_z - same.slope_z) <= 1e-8);
    const double rise = at(2.0).height - edge.height;
    CHECK(std::abs(rise) > 1e-5);
    CHECK(std::abs(at(4.0).height - edge.height - 3.0 * rise) <= 1e-15);
    const double along =
        4e-3 * std::cos(turn) * edge.slope_y + 3e-3 * std::sin(turn) * edge.slope_z;
    CHECK(std::abs(rise - along) <= 1e-15);
    // Slopes are differences, across the ray too.
    const double y = 9e-3 * std::cos(turn);
    const double z = 9e-3 * std::sin(turn);
    const double step = 1e-7;
    const double by_y = (field.at(y + step, z).height - field.at(y - step, z).height) / 2 / step;
    const double by_z = (field.at(y, z + step).height - field.at(y, z - step).height) / 2 / step;
    CHECK(std::abs(field.at(y, z).slope_y - by_y) <= 1e-8);
    CHECK(std::abs(field.at(y, z).slope_z - by_z) <= 1e-8);
  }
}

namespace {

/// A finger of this radius along y, from -10 mm to a round end, up to 80 degrees to its sides.
std::vector<CurvedTaxel> finger_taxels(double radius, double depth) {
  constexpr double degrees = 3.14159265358979 / 180.0;
  std::vector<CurvedTaxel> taxels;
  const auto put = [&](const SpaceVector& middle, const SpaceVector& normal) {
    taxels.push_back({"t" + std::to_string(taxels.size()),
                      combined(1.0, middle, radius - depth, normal),
                      normal,
                      depth,
                      {Quantity::stress_x}});
  };
  for (int k = -4; k <= 4; ++k) {
    const double side = 20.0 * k * degrees;
    for (int row = 0; row < 4; ++row)
      put({0, -2.5e-3 * (4 - row), 0}, {std::sin(side), 0, std::cos(side)});
    for (const double end : {0.0, 25.0, 50.0, 75.0})
      put({0, 0, 0}, {std::cos(end * degrees) * std::sin(side), std::sin(end * degrees),
                      std::cos(end * degrees) * std::cos(side)});
  }
  return taxels;
}

}  // namespace

TEST_CASE("frames are carried over a finger whose end no reference leaves free", "[skin][curved]") {
  const double depth = 2e-3;
  const std::vector<CurvedTaxel> taxels = finger_taxels(8e-3, depth);
  const auto problem = [&](SurfaceFrames frames) {
    return make_problem(
        curved_skin(taxels, {.shape = SurfaceShape::points, .frames = frames}),
        {.youngs_modulus = 2.5e5, .poisson_ratio = 0.48, .layer = Layer{depth, Base::bonded}});
  };
  CHECK_THROWS_WITH(problem(SurfaceFrames::tangent), ContainsSubstring("frames = \"carried\""));
  CHECK(norm(problem(SurfaceFrames::carried).kernel.values) > 0.0);
  const SkinArray skin =
      curved_skin(taxels, {.shape = SurfaceShape::points, .frames = SurfaceFrames::carried});
  CHECK(skin.curved->residual < 0.15 * depth);
  SpaceVector mean{};
  for (const CurvedTaxel& taxel : taxels) mean = combined(1.0, mean, 1.0, *taxel.normal);
  const SurfaceFrame middle = skin.curved->surface.frame(multiple(1.0 / length(mean), mean));
  CHECK(std::abs(dot(middle[2], SpaceVector{0, 1, 0})) <= 1e-14);
  for (const SurfacePlace& place : skin.curved->above) {
    const SurfaceFrame& frame = place.frame;
    for (std::size_t u = 0; u < 3; ++u)
      for (std::size_t v = 0; v < 3; ++v)
        CHECK(std::abs(dot(frame[u], frame[v]) - (u == v ? 1.0 : 0.0)) <= 1e-14);
    // The least rotation turns about the axis across both normals, and moves nothing along it.
    const SpaceVector axis = cross(middle[0], frame[0]);
    for (std::size_t u = 0; u < 3; ++u)
      CHECK(std::abs(dot(axis, frame[u]) - dot(axis, middle[u])) <= 1e-14);
  }
  const CurvedSurface ball({0, 0, 8e-3}, {0, 0, 1}, 1.0 / 8e-3, {0, 1, 0}, SurfaceFrames::carried);
  CHECK_THROWS_WITH(ball.frame({0, 0.1, -std::sqrt(0.99)}), ContainsSubstring("opposite"));
}

TEST_CASE("a skin that is hardly curved has the flat skin's problem", "[skin][curved][property]") {
  const double radius = GENERATE(1e7, -1e7);
  const std::vector<Quantity> reads = {Quantity::stress_x, Quantity::shear_xy,
                                       Quantity::shear_strain_xz, Quantity::displacement_y};
  std::vector<CurvedTaxel> curved;
  std::vector<Taxel> flat;
  const std::vector<std::array<double, 3>> places = {
      {0.0, 0.0, 1e-3}, {1.7e-3, -0.4e-3, 1.5e-3}, {-2e-3, 1e-3, 0.6e-3}, {0.4e-3, 2.2e-3, 1e-3}};
  for (const auto& [y, z, depth] : places) {
    const std::string name = "t" + std::to_string(flat.size());
    // The chart's x is -z of the sensor, its y the sensor's y, so its z is the sensor's x.
    curved.push_back({name, {z, y, -depth}, SpaceVector{0, 0, 1}, depth, reads});
    flat.push_back({name, y, z, depth, reads});
  }
  const SkinProblemOptions options{.channel_rms = {10.0, 10.0, 1e-4, 1e-6}};
  const LinearProblem expected = make_problem(uneven_skin(flat), skin_on_core, options);
  const SkinArray skin =
      curved_skin(curved, {.centre = SpaceVector{0, 0, -radius}, .radius = radius});
  const LinearProblem found = make_problem(skin, skin_on_core, options);
  REQUIRE(found.grid.rows == expected.grid.rows);
  REQUIRE(found.grid.columns == expected.grid.columns);
  CHECK(std::abs(found.grid.spacing_y - expected.grid.spacing_y) <= 1e-12);
  CHECK(distance(found.kernel.values, expected.kernel.values) <=
        1e-8 * norm(expected.kernel.values));
  CHECK(found.smoothing_length == expected.smoothing_length);
  CHECK(std::abs(found.measure / expected.measure - 1.0) <= 1e-9);
}

TEST_CASE("a plane's problem is the flat one to ten digits", "[skin][curved]") {
  std::vector<CurvedTaxel> curved;
  std::vector<Taxel> flat;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double y = 1.1e-3 * i;
      const double z = 0.9e-3 * j;
      const std::string name = "t" + std::to_string(flat.size());
      curved.push_back({name, {z, y, -1.2e-3}, SpaceVector{0, 0, 1}, 1.2e-3, moves});
      flat.push_back({name, y - 1.65e-3, z - 1.35e-3, 1.2e-3, moves});
    }
  const auto shape = GENERATE(SurfaceShape::sphere, SurfaceShape::points);
  const LinearProblem expected = make_problem(uneven_skin(flat), skin_on_core);
  const LinearProblem found = make_problem(curved_skin(curved, {.shape = shape}), skin_on_core);
  CHECK(distance(found.kernel.values, expected.kernel.values) <=
        1e-10 * norm(expected.kernel.values));
}

TEST_CASE("a surface through the taxels of a sphere is that sphere", "[skin][curved]") {
  const double radius = GENERATE(15e-3, 30e-3);
  const std::vector<CurvedTaxel> taxels = ball_taxels(radius);
  const SkinArray sphere = curved_skin(taxels);
  const SkinArray points = curved_skin(taxels, {.shape = SurfaceShape::points});
  CHECK(sphere.curved->shape == SurfaceShape::sphere);
  CHECK(std::abs(sphere.curved->surface.curvature() * radius - 1.0) <= 1e-12);
  for (const SurfacePlace& place : points.curved->above) {
    CHECK(std::abs(place.mean_curvature * radius - 1.0) <= 1e-6);
    CHECK(place.curvature_difference * radius <= 1e-3);
  }
  const SkinArray fitted = [&] {
    std::vector<CurvedTaxel> without = taxels;
    for (CurvedTaxel& taxel : without) taxel.normal.reset();
    return curved_skin(without, {.shape = SurfaceShape::sphere});
  }();
  CHECK(std::abs(fitted.curved->surface.curvature() * radius - 1.0) <= 1e-9);
  CHECK(length(combined(1.0, fitted.curved->above[3].point, -1.0, sphere.curved->above[3].point)) <=
        1e-11);
}

TEST_CASE("an ellipsoid's taxels tell its curvatures", "[skin][curved]") {
  const SpaceVector half_axes = {12e-3, 20e-3, 14e-3};
  const SkinArray skin = curved_skin(taxels_below(half_axes, 5e-3, 9, 1.2e-3, moves));
  REQUIRE(skin.curved->shape == SurfaceShape::points);
  CHECK(skin.curved->residual <= 1e-5);
  // At the apex: c / a^2 and c / b^2.
  const auto at = skin.curved->surface.chart({0, 0, half_axes[2]});
  const SurfacePlace apex = skin.curved->surface.at(at.y, at.z);
  const double along_x = half_axes[2] / std::pow(half_axes[0], 2);
  const double along_y = half_axes[2] / std::pow(half_axes[1], 2);
  CHECK(std::abs(apex.mean_curvature / (0.5 * (along_x + along_y)) - 1.0) <= 0.01);
  CHECK(std::abs(apex.curvature_difference / (along_x - along_y) - 1.0) <= 0.03);
}

TEST_CASE("a fingertip that is wider than its narrowest ball has a problem", "[skin][curved]") {
  const SpaceVector half_axes = {8e-3, 30e-3, 16e-3};
  std::vector<CurvedTaxel> taxels = taxels_below(half_axes, 6e-3, 5, 1e-3, moves);
  for (CurvedTaxel& taxel : taxels_below({8e-3, 30e-3, 16e-3}, 4e-3, 3, 1e-3, moves)) {
    if (std::abs(taxel.place[1]) < 1e-3) continue;
    // The same, further along the finger.
    const double y = taxel.place[1] * 4.5;
    const double z =
        16e-3 * std::sqrt(1.0 - std::pow(taxel.place[0] / 8e-3, 2) - std::pow(y / 30e-3, 2));
    SpaceVector normal = {taxel.place[0] / 64e-6, y / 900e-6, z / 256e-6};
    normal = multiple(1.0 / length(normal), normal);
    taxel.name += "_far";
    taxel.place = combined(1.0, {taxel.place[0], y, z}, -1e-3, normal);
    taxel.normal = normal;
    taxels.push_back(taxel);
  }
  Material thin = skin_on_core;
  thin.layer = Layer{2e-3, Base::bonded};
  const LinearProblem problem = make_problem(curved_skin(taxels), thin);
  for (const double entry : problem.kernel.values) CHECK(std::isfinite(entry));
}

TEST_CASE("sums of a curved skin's tractions are the resultant about any point",
          "[skin][curved][property]") {
  const LinearProblem problem = make_problem(
      curved_skin(taxels_below({12e-3, 20e-3, 14e-3}, 4e-3, 5, 1.2e-3, moves)), skin_on_core);
  const SkinArray skin = curved_skin(taxels_below({12e-3, 20e-3, 14e-3}, 4e-3, 5, 1.2e-3, moves));
  std::vector<double> on_surface = some_tractions(problem);
  const TikhonovFamily family(problem);
  const TractionCovariance covariance(family, 1e-20, 1e-20);
  std::vector<std::size_t> cells(problem.grid.count());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i;
  const std::vector<double> tractions = on_surface;
  put_on_surface(problem, on_surface);
  SpaceVector force{};
  SpaceVector moment{};
  double pressed = 0.0;
  for (const std::size_t i : cells) {
    const SurfaceCell& cell = (*problem.cells)[i];
    for (std::size_t u = 0; u < 3; ++u) {
      force = combined(1.0, force, on_surface[u * cells.size() + i], cell.force[u]);
      moment = combined(1.0, moment, on_surface[u * cells.size() + i], cell.moment[u]);
    }
    pressed += on_surface[i] * cell.area;
  }
  const UncertainWrench chart = resultant_of(problem.grid, tractions, cells, covariance, 1.0);
  CHECK(std::abs(chart.normal.value / pressed - 1.0) <= 1e-13);
  for (const SpaceVector& about : {SpaceVector{}, SpaceVector{3e-3, -1e-2, 4e-2}}) {
    const SpaceWrench found =
        space_wrench(problem, tractions, cells, covariance, 1.0, chart, about);
    const SpaceVector expected = combined(1.0, moment, -1.0, cross(about, force));
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(std::abs(found.force[k].value - force[k]) <= 1e-12 * length(force));
      CHECK(std::abs(found.moment[k].value - expected[k]) <= 1e-12 * length(force) * 5e-2);
    }
  }
}

TEST_CASE("a skin that is turned and moved gives turned forces", "[skin][curved][property]") {
  const Turn turn = turn_about({0.3, -0.5, 0.8}, 1.1, {0.1, -0.05, 0.02});
  const auto shape = GENERATE(SurfaceShape::sphere, SurfaceShape::points, SurfaceShape::mesh);
  const SpaceVector half_axes = shape == SurfaceShape::sphere ? SpaceVector{15e-3, 15e-3, 15e-3}
                                                              : SpaceVector{12e-3, 20e-3, 14e-3};
  const std::vector<CurvedTaxel> taxels = taxels_below(half_axes, 5e-3, 6, 1.2e-3, moves);
  std::vector<CurvedTaxel> turned = taxels;
  for (CurvedTaxel& taxel : turned) {
    taxel.place = turn.place(taxel.place);
    taxel.normal = turn.direction(*taxel.normal);
  }
  CurvedSkinOptions options{.shape = shape, .axes = ReadingAxes::sensor};
  CurvedSkinOptions turned_options = options;
  if (shape == SurfaceShape::mesh) {
    SurfaceMesh mesh = ellipsoid_mesh(half_axes, 8e-3, 16);
    options.mesh = std::make_shared<const SurfaceMesh>(mesh);
    for (SpaceVector& vertex : mesh.vertices) vertex = turn.place(vertex);
    turned_options.mesh = std::make_shared<const SurfaceMesh>(std::move(mesh));
  }
  turned_options.reference = turn.direction(options.reference);
  const SkinArray skin = curved_skin(taxels, options);
  const LinearProblem problem = make_problem(skin, skin_on_core);
  const LinearProblem moved = make_problem(curved_skin(turned, turned_options), skin_on_core);
  REQUIRE(moved.grid.count() == problem.grid.count());
  const std::size_t taxel_count = taxels.size();
  const auto turned_readings = [&](const auto& of) {
    std::vector<double> seen(3 * taxel_count);
    for (std::size_t i = 0; i < taxel_count; ++i) {
      const SpaceVector there =
          turn.direction({of(i), of(taxel_count + i), of(2 * taxel_count + i)});
      for (std::size_t k = 0; k < 3; ++k) seen[k * taxel_count + i] = there[k];
    }
    return seen;
  };
  double apart = 0.0;
  for (std::size_t column = 0; column < problem.kernel.columns; ++column) {
    const std::vector<double> seen =
        turned_readings([&](std::size_t row) { return problem.kernel(row, column); });
    for (std::size_t row = 0; row < seen.size(); ++row)
      apart = std::hypot(apart, seen[row] - moved.kernel(row, column));
  }
  CHECK(apart <= 1e-11 * norm(problem.kernel.values));
  const std::vector<SkinLoad> loads = {
      SkinContact{.y = 0.7e-3,
                  .z = -1.4e-3,
                  .radius = 2e-3,
                  .force = 0.3,
                  .friction = 0.4,
                  .direction = 1.0},
      SkinContact{.y = -2e-3, .z = 2e-3, .radius = 1.5e-3, .force = 0.1}};
  std::vector<double> readings = exact_readings(skin, skin_on_core, loads);
  std::mt19937 random(5);
  std::normal_distribution<double> number(0.0, 1e-7);
  for (double& one : readings) one += number(random);
  const std::vector<double> seen = turned_readings([&](std::size_t i) { return readings[i]; });
  const auto force_of = [](const LinearProblem& one, const std::vector<double>& frame,
                           double alpha) {
    const TikhonovFamily family(one);
    const std::vector<double> f = family.solve(family.analyse(frame), alpha);
    SpaceVector force{};
    for (std::size_t i = 0; i < f.size(); ++i) {
      const SurfaceCell& cell = (*one.cells)[i % one.grid.count()];
      force = combined(1.0, force, f[i] * one.grid.area() / cell.area,
                       cell.force[i / one.grid.count()]);
    }
    return force;
  };
  for (const double alpha : {1e-18, 1e-20, 1e-22}) {
    const SpaceVector expected = turn.direction(force_of(problem, readings, alpha));
    const SpaceVector found = force_of(moved, seen, alpha);
    CHECK(length(combined(1.0, found, -1.0, expected)) <= 1e-11 * length(expected));
  }
}

TEST_CASE("what is no curved skin is refused with the rule", "[skin][curved]") {
  const std::vector<CurvedTaxel> good = ball_taxels(15e-3);
  const auto refused = [](const std::vector<CurvedTaxel>& taxels, const CurvedSkinOptions& options,
                          const std::string& rule) {
    CHECK_THROWS_WITH(curved_skin(taxels, options), ContainsSubstring(rule));
  };
  refused({}, {}, "at least one taxel");
  std::vector<CurvedTaxel> bad = good;
  bad[7].normal = multiple(1.01, *bad[7].normal);
  refused(bad, {}, "normal of taxel t1_2 must be of length 1");
  bad = good;
  bad[7].normal = multiple(-1.0, *bad[7].normal);
  refused(bad, {}, "t1_2");
  bad = good;
  for (CurvedTaxel& taxel : bad) taxel.normal = multiple(-1.0, *taxel.normal);
  refused(bad, {}, "turn them outward");
  refused(bad, {.radius = 15e-3}, "turn them outward");
  bad = good;
  bad[0].normal.reset();
  refused(bad, {}, "needs its outward normal");
  bad = good;
  bad[3].depth = -1e-3;
  refused(bad, {}, "depth of taxel t0_3");
  bad = good;
  bad[3].place = bad[4].place;
  bad[3].normal = bad[4].normal;
  refused(bad, {}, "t0_3");
  refused(good, {.radius = 0.0}, "radius");
  refused(good, {.shape = SurfaceShape::points, .radius = 15e-3}, "a sphere's");
  refused(good, {.reference = {0, 0, 1}}, "within 10 degrees");
  bad.assign(good.begin(), good.begin() + 3);
  for (CurvedTaxel& taxel : bad) taxel.normal.reset();
  refused(bad, {.shape = SurfaceShape::sphere}, "four taxels");

  const SkinArray skin = curved_skin(good);
  Material material = skin_on_core;
  material.layer.reset();
  CHECK_THROWS_WITH(make_problem(skin, material), ContainsSubstring("thickness"));
  material.layer = Layer{4e-3, Base::frictionless};
  CHECK_THROWS_WITH(make_problem(skin, material), ContainsSubstring("bonded"));
  material.layer = Layer{16e-3, Base::bonded};
  CHECK_THROWS_WITH(make_problem(skin, material), ContainsSubstring("radius of curvature"));
}

TEST_CASE("readings of loads on a curved skin are those of its problem's cells, and converge",
          "[skin][curved][property]") {
  const SkinArray skin = curved_skin(ball_taxels(15e-3), {.axes = ReadingAxes::sensor});
  const std::vector<SkinLoad> loads = {
      SkinContact{.y = 0.7e-3,
                  .z = -0.4e-3,
                  .radius = 2e-3,
                  .force = 0.3,
                  .friction = 0.4,
                  .direction = 1.0},
      SkinContact{.y = -2e-3, .z = 1e-3, .radius = 1.5e-3, .force = 0.1, .torsion = 2e-5}};
  const std::vector<double> exact = exact_readings(skin, skin_on_core, loads);
  const SkinProblemOptions fine{.grid = {.spacing = 0.1e-3}};
  const LinearProblem problem = make_problem(skin, skin_on_core, fine);
  const std::vector<double> sampled = product(problem.kernel, cell_means(loads, problem.grid));
  CHECK(distance(exact, sampled) <= 1e-3 * norm(exact));
  CHECK(
      distance(sampled_readings(skin, skin_on_core, problem.grid, cell_means(loads, problem.grid)),
               sampled) <= 1e-12 * norm(exact));
  // Cells of half a spacing leave a quarter of the error: what is left of both together is far
  // less.
  const LinearProblem coarse = make_problem(skin, skin_on_core, {.grid = {.spacing = 0.2e-3}});
  const std::vector<double> two = product(coarse.kernel, cell_means(loads, coarse.grid));
  std::vector<double> both(exact.size());
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = sampled[i] + (sampled[i] - two[i]) / 3.0;
  CHECK(distance(exact, both) <= 1e-4 * norm(exact));
  CHECK(norm(exact_readings(skin, skin_on_core, {})) == 0.0);
}
