#include "tactile_net/lab/rigid_contacts.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net::lab {
namespace {

const ContactWidths widths{.breadth = 0.02, .edge = 1e-3};

LoadPatch only_load(const std::vector<ContactPoint>& points) {
  const ContactPatches found = contact_patches(points, silicone, widths);
  REQUIRE(found.loads.size() == 1);
  return found.loads.front();
}

/// Tractions at both ends.
std::pair<double, double> ends(const LoadPatch& patch) {
  const double a = patch.half_width;
  const double mean = 0.5 * patch.normal / a;
  const double rise = 1.5 * patch.moment / (a * a);
  return {mean - rise, mean + rise};
}

}  // namespace

TEST_CASE("a round object is Hertz' strip", "[lab][rigid]") {
  const LoadPatch patch =
      only_load({{.curvature = 100.0, .along = 2e-3, .normal = 1.0, .tangential = -0.3}});
  CHECK(patch.form == LoadPatch::Form::hertz);
  CHECK(patch.center == 2e-3);
  CHECK_THAT(patch.normal, WithinRel(50.0, 1e-15));
  CHECK_THAT(patch.tangential, WithinRel(-15.0, 1e-15));
  const double modulus = 0.2e6 / (1.0 - 0.45 * 0.45);
  const double half = std::sqrt(4.0 * 50.0 * 0.01 / (std::numbers::pi * modulus));
  CHECK_THAT(patch.half_width, WithinRel(half, 1e-14));
}

TEST_CASE("a cylinder's two points at its ends are one strip, a lying one's are not",
          "[lab][rigid]") {
  const LoadPatch across = only_load({{.curvature = 100.0, .across = -0.01, .normal = 0.5},
                                      {.curvature = 100.0, .across = 0.01, .normal = 0.5}});
  CHECK(across.form == LoadPatch::Form::hertz);
  CHECK_THAT(across.normal, WithinRel(50.0, 1e-15));
  const LoadPatch along = only_load({{.curvature = 100.0, .along = -0.01, .normal = 0.5},
                                     {.curvature = 100.0, .along = 0.01, .normal = 0.5}});
  CHECK(along.form == LoadPatch::Form::linear);
  CHECK(along.half_width == 0.01);
}

TEST_CASE("several points are a linear traction with their force and moment", "[lab][rigid]") {
  const LoadPatch patch =
      only_load({{.along = -4e-3, .across = -5e-3, .normal = 1.0, .tangential = 0.1},
                 {.along = 8e-3, .across = 5e-3, .normal = 1.5, .tangential = 0.3}});
  CHECK(patch.form == LoadPatch::Form::linear);
  CHECK_THAT(patch.half_width, WithinRel(6e-3, 1e-14));
  CHECK_THAT(patch.normal, WithinRel(2.5 / 0.02, 1e-14));
  CHECK_THAT(patch.tangential, WithinRel(0.4 / 0.02, 1e-14));
  CHECK_THAT(patch.normal * patch.center + patch.moment,
             WithinRel((-4e-3 * 1.0 + 8e-3 * 1.5) / 0.02, 1e-13));
}

TEST_CASE("where the load comes to an end the patch narrows and pulls nowhere", "[lab][rigid]") {
  for (const double share : {0.5, 0.6, 0.7, 0.9, 0.99, 1.0}) {
    CAPTURE(share);
    const LoadPatch patch = only_load(
        {{.along = -4e-3, .normal = 1.0 - share}, {.along = 8e-3, .normal = share}, {.object = 0}});
    const auto [from, to] = ends(patch);
    CHECK(from >= -1e-9 * to);
    CHECK(to > 0.0);
    CHECK(patch.half_width >= 0.5 * widths.edge);
    CHECK_THAT(patch.normal * patch.center + patch.moment,
               WithinRel((-4e-3 * (1.0 - share) + 8e-3 * share) / 0.02, 1e-12));
  }
}

TEST_CASE("an edge has the width that is stated, and every object a patch", "[lab][rigid]") {
  const LoadPatch edge = only_load({{.along = 3e-3, .normal = 1.0}});
  CHECK(edge.form == LoadPatch::Form::linear);
  CHECK(edge.half_width == 0.5e-3);
  CHECK(edge.center == 3e-3);
  CHECK(edge.moment == 0.0);

  const ContactPatches found =
      contact_patches(std::vector<ContactPoint>{{.object = 4, .across = 0.0, .normal = 1.0},
                                                {.object = 2, .across = 1e-3, .normal = 1.0},
                                                {.object = 4, .across = 5e-3, .normal = 1.0},
                                                {.object = 2, .across = 9e-3, .normal = 1.0},
                                                {.object = 7, .across = 0.0, .normal = 0.0},
                                                {.object = 8, .across = 0.0, .normal = -1.0}},
                      silicone, widths);
  CHECK(found.loads.size() == 2);
  CHECK_THAT(found.shortest.value(), WithinRel(5e-3, 1e-14));
  CHECK_FALSE(contact_patches({}, silicone, widths).shortest.has_value());
}

TEST_CASE("a face sees contacts in the array's frame, whichever object is the first",
          "[lab][rigid]") {
  // Upside down: z down, x along the world's y. What touches it from below presses up.
  const PadFace face{.origin = {1.0, 2.0, 3.0}, .axes = {0, 1, 0, 1, 0, 0, 0, 0, -1}};
  PairContact contact{.position = {1.5, 2.25, 3.0},
                      .frame = {0, 0, 1, 0, 1, 0, -1, 0, 0},  // up, the world's y, its -x
                      .force = {6.0, 5.0, -4.0}};
  const PadFace::Touch as_second = face.touched_by(contact, true);
  contact.frame = {0, 0, -1, 0, 1, 0, 1, 0, 0};
  contact.force = {6.0, -5.0, -4.0};
  const PadFace::Touch as_first = face.touched_by(contact, false);
  for (const PadFace::Touch& touch : {as_second, as_first}) {
    CHECK(touch.facing == 1.0);
    CHECK(touch.point.along == 0.25);
    CHECK(touch.point.across == 0.5);
    CHECK(touch.point.normal == 6.0);
    CHECK(touch.point.tangential == 5.0);
  }
  CHECK(face.touched_by(contact, true).facing == -1.0);
}

TEST_CASE("an edge is half the least depth wide unless stated", "[lab][rigid]") {
  const Scene scene = parse_scene(
      "[sensor]\ncount = 5\npitch = 1.0\ndepths = [3.0, 2.0]\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n",
      "pad.toml");
  CHECK(contact_widths(scene, 4.0).edge == 1.0);
  CHECK(contact_widths(scene, 4.0, 0.1).edge == 0.1);
  CHECK_THROWS_AS(contact_widths(scene, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(contact_widths(scene, 1.0, -1.0), std::invalid_argument);
}

}  // namespace tactile_net::lab
