#include "tactile_net/lab/skin_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net::lab {
namespace {

constexpr double edge = 1e-3;

/// Cells of half a millimetre whose middles are at whole halves.
const SurfaceGrid cells{.rows = 41, .columns = 41, .spacing_y = 0.5e-3, .spacing_z = 0.5e-3};

SampledPatch only_patch(const std::vector<ContactPoint>& points, const SurfaceGrid& grid = cells) {
  const std::vector<SampledPatch> found = skin_patches(points, silicone, edge, grid);
  REQUIRE(found.size() == 1);
  check(found.front());
  return found.front();
}

/// Of the cells that press: how far they reach along y and z.
std::pair<double, double> pressed_extent(const SampledPatch& patch) {
  std::vector<std::size_t> rows;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < patch.normal.size(); ++i)
    if (patch.normal[i] > 0.0) {
      rows.push_back(i / patch.columns);
      columns.push_back(i % patch.columns);
    }
  const auto extent = [](const std::vector<std::size_t>& of) {
    const auto [low, high] = std::minmax_element(of.begin(), of.end());
    return static_cast<double>(*high - *low + 1);
  };
  return {extent(rows) * patch.spacing_y, extent(columns) * patch.spacing_z};
}

/// Of the points themselves, y along and z against the simulator's second axis.
SkinWrench wrench_of(const std::vector<ContactPoint>& points) {
  SkinWrench sum;
  for (const ContactPoint& point : points) {
    const double y = point.along;
    const double z = -point.across;
    sum += {.force = {point.normal, point.tangential, -point.sideways},
            .moment_y = y * point.normal,
            .moment_z = z * point.normal,
            .torque = y * -point.sideways - z * point.tangential};
  }
  return sum;
}

void check_same(const SkinWrench& found, const SkinWrench& wanted, double size) {
  for (std::size_t k = 0; k < 3; ++k)
    CHECK_THAT(found.force[k], WithinAbs(wanted.force[k], 1e-12 * wanted.force[0]));
  CHECK_THAT(found.moment_y, WithinAbs(wanted.moment_y, 1e-12 * size * wanted.force[0]));
  CHECK_THAT(found.moment_z, WithinAbs(wanted.moment_z, 1e-12 * size * wanted.force[0]));
  CHECK_THAT(found.torque, WithinAbs(wanted.torque, 1e-12 * size * wanted.force[0]));
}

}  // namespace

TEST_CASE("a ball is Hertz' circle", "[lab][rigid][skin]") {
  const std::vector<ContactPoint> ball{{.curvature = 50.0,
                                        .along = 2.1e-3,
                                        .across = 1.3e-3,
                                        .normal = 1.0,
                                        .tangential = -0.3,
                                        .sideways = 0.1}};
  const SampledPatch patch = only_patch(ball);
  check_same(resultant(patch), wrench_of(ball), 2e-3);
  // Johnson 1985, 4.22: a^3 = 3 F R / (4 E*); 3.58: p0 = 3 F / (2 pi a^2).
  const double radius = std::cbrt(3.0 * 0.02 * (1.0 - 0.45 * 0.45) / (4.0 * 0.2e6));
  const SkinLoad exact = SkinContact{.y = 2.1e-3, .z = -1.3e-3, .radius = radius, .force = 1.0};
  const std::vector<double> means = cell_means(std::span(&exact, 1), cells);
  const double peak = *std::max_element(means.begin(), means.end());
  for (std::size_t i = 0; i < patch.normal.size(); ++i) {
    const auto at = [](double place, double spacing, std::size_t count) {
      return static_cast<std::size_t>(
          std::lround(place / spacing + 0.5 * static_cast<double>(count - 1)));
    };
    const std::size_t row =
        at(patch.y + centred(i / patch.columns, patch.rows) * 0.5e-3, 0.5e-3, 41);
    const std::size_t column =
        at(patch.z + centred(i % patch.columns, patch.columns) * 0.5e-3, 0.5e-3, 41);
    CHECK_THAT(patch.normal[i], WithinAbs(means[row * 41 + column], 0.03 * peak));
  }
}

TEST_CASE("contacts keep their force, centre and torque, and pull nowhere", "[lab][rigid][skin]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-8e-3, 8e-3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    std::vector<ContactPoint> points;
    const int count = 1 + trial % 8;
    for (int i = 0; i < count; ++i)
      points.push_back({.along = place(random),
                        .across = place(random),
                        .normal = 0.01 + share(random) * share(random),
                        .tangential = 0.3 * (share(random) - 0.5),
                        .sideways = 0.3 * (share(random) - 0.5)});
    const SampledPatch found = only_patch(points);
    check_same(resultant(found), wrench_of(points), 8e-3);
    CHECK(*std::min_element(found.normal.begin(), found.normal.end()) >= 0.0);
  }
}

TEST_CASE("a box that stands evenly presses evenly over its face", "[lab][rigid][skin]") {
  std::vector<ContactPoint> corners;
  for (const double y : {-5.75e-3, 5.75e-3})  // cells' borders
    for (const double z : {-3.75e-3, 3.75e-3})
      corners.push_back({.along = y, .across = z, .normal = 0.25});
  const SampledPatch box = only_patch(corners);
  CHECK_THAT(pressed_extent(box).first, WithinRel(11.5e-3, 1e-12));
  for (const double p : box.normal)
    if (p != 0.0) CHECK_THAT(p, WithinRel(1.0 / (11.5e-3 * 7.5e-3), 1e-9));
  CHECK(box.tangential_y.empty());
}

TEST_CASE("a box that tilts presses linearly, and beyond the kernel on a part",
          "[lab][rigid][skin]") {
  const double length = 11.5e-3;
  const auto leaning = [&](double more) {
    std::vector<ContactPoint> corners;
    for (const double y : {-0.5 * length, 0.5 * length})
      for (const double z : {-3.75e-3, 3.75e-3})
        corners.push_back({.along = y, .across = z, .normal = 0.25 + (y > 0.0 ? more : -more)});
    return only_patch(corners);
  };
  // Within a sixth of the length all of it presses: p = F/A (1 + 12 e y / l^2), where n cells of
  // uniform pressure have the plane's moment only if it is 1 / (1 - 1/n^2) steeper.
  const SampledPatch all = leaning(0.05);
  const double off = 4.0 * 0.05 * 0.5 * length;
  const double slope = 12.0 * off / (length * length) / (1.0 - 1.0 / (23.0 * 23.0));
  for (std::size_t i = 0; i < all.normal.size(); ++i) {
    const double y = all.y + centred(i / all.columns, all.rows) * all.spacing_y;
    if (all.normal[i] != 0.0)
      CHECK_THAT(all.normal[i], WithinRel((1.0 + slope * y) / (length * 7.5e-3), 1e-9));
  }
  // Beyond, the far side is free, and a triangle is three times as long as the force is from the
  // rim.
  const SampledPatch part = leaning(0.1875);
  const double from_rim = 0.5 * length - 4.0 * 0.1875 * 0.5 * length;
  CHECK_THAT(pressed_extent(part).first, WithinAbs(3.0 * from_rim, 0.5e-3));
}

TEST_CASE("edges, corners and lying cylinders are as wide as they can be seen",
          "[lab][rigid][skin]") {
  const SampledPatch corner = only_patch({{.along = 1e-3, .normal = 1.0}});
  CHECK_THAT(pressed_extent(corner).first, WithinAbs(edge, 0.51e-3));
  const SampledPatch side =
      only_patch({{.along = -5e-3, .normal = 1.0}, {.along = 5e-3, .normal = 1.0}});
  CHECK_THAT(pressed_extent(side).first, WithinAbs(1e-2, 0.51e-3));
  CHECK_THAT(pressed_extent(side).second, WithinAbs(edge, 0.51e-3));
  // Johnson 1985, 4.43: b^2 = 4 P' R / (pi E*), of 200 N/m.
  const double half =
      std::sqrt(4.0 * 200.0 * 0.1 * (1.0 - 0.45 * 0.45) / (3.14159265358979 * 0.2e6));
  const SampledPatch cylinder = only_patch({{.curvature = 10.0, .along = -15e-3, .normal = 3.0},
                                            {.curvature = 10.0, .along = 15e-3, .normal = 3.0}});
  CHECK_THAT(pressed_extent(cylinder).second, WithinAbs(2.0 * half, 0.51e-3));
}

TEST_CASE("cells go on beyond the grid, and whoever mixes up units is told", "[lab][rigid][skin]") {
  const std::vector<ContactPoint> far{
      {.curvature = 100.0, .along = 30e-3, .across = -1e-3, .normal = 1.0}};
  check_same(resultant(only_patch(far)), wrench_of(far), 30e-3);
  const std::vector<ContactPoint> wide{{.along = -20.0, .across = -20.0, .normal = 1.0},
                                       {.along = 20.0, .across = 20.0, .normal = 1.0}};
  CHECK_THROWS_AS(skin_patches(wide, silicone, edge, cells), std::invalid_argument);
}

TEST_CASE("each object has a load, and points that do not press have none", "[lab][rigid][skin]") {
  const std::vector<ContactPoint> two{{.object = 3, .curvature = 50.0, .normal = 1.0},
                                      {.object = 1, .normal = 1.0},
                                      {.object = 1, .along = 3e-3, .normal = 0.0},
                                      {.object = 2, .normal = -1.0}};
  CHECK(skin_patches(two, silicone, edge, cells).size() == 2);
  CHECK(skin_patches({}, silicone, edge, cells).empty());
  CHECK_THROWS_AS(skin_patches({}, silicone, 0.0, cells), std::invalid_argument);
  CHECK_THROWS_AS(skin_patches({}, silicone, std::nan(""), cells), std::invalid_argument);
}

}  // namespace tactile_net::lab
