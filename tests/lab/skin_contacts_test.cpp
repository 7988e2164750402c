#include "tactile_net/lab/skin_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <variant>
#include <vector>

#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
constexpr double edge = 1e-3;

SkinLoad only(const std::vector<ContactPoint>& points) {
  const std::vector<SkinLoad> found = skin_loads(points, silicone, edge);
  REQUIRE(found.size() == 1);
  check(found.front());
  return found.front();
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

const SampledPatch& patch(const SkinLoad& load) {
  REQUIRE(std::holds_alternative<SampledPatch>(load));
  return std::get<SampledPatch>(load);
}

}  // namespace

TEST_CASE("a ball is Hertz' circle", "[lab][rigid][skin]") {
  const std::vector<ContactPoint> ball{{.curvature = 100.0,
                                        .along = 2e-3,
                                        .across = 1e-3,
                                        .normal = 1.0,
                                        .tangential = -0.3,
                                        .sideways = 0.1}};
  const SkinLoad load = only(ball);
  const auto& circle = std::get<SkinContact>(load);
  CHECK(circle.shape == SkinShape::sphere);
  // Johnson 1985, 4.22: a^3 = 3 F R / (4 E*).
  CHECK_THAT(std::pow(circle.radius, 3.0),
             WithinRel(3.0 * 0.01 * (1.0 - 0.45 * 0.45) / (4.0 * 0.2e6), 1e-14));
  check_same(resultant(load), wrench_of(ball), 2e-3);
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
    const SkinLoad load = only(points);
    check_same(resultant(load), wrench_of(points), 8e-3);
    const SampledPatch& found = patch(load);
    CHECK(*std::min_element(found.normal.begin(), found.normal.end()) >= 0.0);
  }
}

TEST_CASE("a box that stands evenly presses evenly over its face", "[lab][rigid][skin]") {
  std::vector<ContactPoint> corners;
  for (const double y : {-6e-3, 6e-3})
    for (const double z : {-4e-3, 4e-3})
      corners.push_back({.along = y, .across = z, .normal = 0.25});
  const SampledPatch& box = patch(only(corners));
  CHECK_THAT(box.spacing_y * static_cast<double>(box.rows), WithinRel(12e-3, 1e-12));
  CHECK_THAT(box.spacing_z * static_cast<double>(box.columns), WithinRel(8e-3, 1e-12));
  for (const double p : box.normal) CHECK_THAT(p, WithinRel(1.0 / 96e-6, 1e-9));
  CHECK(box.tangential_y.empty());
}

TEST_CASE("a box that tilts presses linearly, and beyond the kernel on a part",
          "[lab][rigid][skin]") {
  const auto leaning = [](double more) {
    std::vector<ContactPoint> corners;
    for (const double y : {-6e-3, 6e-3})
      for (const double z : {-4e-3, 4e-3})
        corners.push_back({.along = y, .across = z, .normal = 0.25 + (y > 0.0 ? more : -more)});
    return corners;
  };
  // Within a sixth of the length all of it presses: p = F/A (1 + 12 e y / l^2).
  const SkinLoad slight = only(leaning(0.05));
  const SampledPatch& all = patch(slight);
  const double off = 4.0 * 0.05 * 6e-3;
  for (std::size_t i = 0; i < all.normal.size(); ++i) {
    const double y =
        (static_cast<double>(i / all.columns) + 0.5 - 0.5 * static_cast<double>(all.rows)) *
        all.spacing_y;
    // Rectangles have the same moment as the plane only if its slope is a little steeper.
    const double n = static_cast<double>(all.rows);
    const double slope = 12.0 * off / (12e-3 * 12e-3) / (1.0 - 1.0 / (n * n));
    CHECK_THAT(all.normal[i], WithinRel((1.0 + slope * y) / 96e-6, 1e-9));
  }
  // Beyond, the far side is free, and the triangle's length is three times the force's way to the
  // rim (1.5 mm here, of 12): 4.5 mm.
  const SkinLoad strong = only(leaning(0.1875));
  const SampledPatch& part = patch(strong);
  CHECK(part.normal.front() == 0.0);
  const auto pressed = static_cast<double>(
      std::count_if(part.normal.begin(), part.normal.end(), [](double p) { return p > 0.0; }));
  CHECK_THAT(pressed / static_cast<double>(part.normal.size()), WithinAbs(4.5 / 12.0, 1.0 / 12.0));
}

TEST_CASE("edges, corners and lying cylinders are as wide as they can be seen",
          "[lab][rigid][skin]") {
  const SampledPatch& corner = patch(only({{.along = 1e-3, .normal = 1.0}}));
  CHECK_THAT(corner.spacing_y * static_cast<double>(corner.rows), WithinRel(edge, 1e-12));
  CHECK_THAT(corner.y, WithinRel(1e-3, 1e-12));
  const SkinLoad side = only({{.along = -5e-3, .normal = 1.0}, {.along = 5e-3, .normal = 1.0}});
  CHECK_THAT(patch(side).spacing_y * static_cast<double>(patch(side).rows), WithinRel(1e-2, 1e-12));
  CHECK_THAT(patch(side).spacing_z * static_cast<double>(patch(side).columns),
             WithinRel(edge, 1e-12));
  const SkinLoad cylinder = only({{.curvature = 100.0, .along = -5e-3, .normal = 1.0},
                                  {.curvature = 100.0, .along = 5e-3, .normal = 1.0}});
  // Johnson 1985, 4.43: b^2 = 4 P' R / (pi E*), of 200 N/m.
  const double half =
      std::sqrt(4.0 * 200.0 * 0.01 * (1.0 - 0.45 * 0.45) / (3.14159265358979 * 0.2e6));
  CHECK_THAT(patch(cylinder).spacing_z * static_cast<double>(patch(cylinder).columns),
             WithinRel(2.0 * half, 1e-9));
}

TEST_CASE("each object has a load, and points that do not press have none", "[lab][rigid][skin]") {
  const std::vector<ContactPoint> two{{.object = 3, .curvature = 50.0, .normal = 1.0},
                                      {.object = 1, .normal = 1.0},
                                      {.object = 1, .along = 3e-3, .normal = 0.0},
                                      {.object = 2, .normal = -1.0}};
  CHECK(skin_loads(two, silicone, edge).size() == 2);
  CHECK(skin_loads({}, silicone, edge).empty());
  CHECK_THROWS_AS(skin_loads({}, silicone, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(skin_loads({}, silicone, std::nan("")), std::invalid_argument);
}

}  // namespace tactile_net::lab
