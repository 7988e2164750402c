#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lab/skin_unseen_width.hpp"
#include "tactile_net/lab/identify.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

using namespace tactile_net;

namespace {

SkinScene skin_that_reads(const std::string& reads, const std::string& depth = "depth = 1.0",
                          const std::string& more = "") {
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 6\ncolumns = 6\npitch = 1.0\n" + depth + "\nreads = [" + reads +
          "]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[[contact]]\nshape = "
          "\"sphere\"\nplace = [0.0, 0.0]\nradius = 1.5\nforce = 1.0\n[noise]\nrms = 0.001\n" +
          more,
      "skin.toml"));
}

bool says(const std::vector<std::string>& sentences, const std::string& text) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return sentence.find(text) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("what determines p and the drags is told, and what nothing shows is named",
          "[lab][skin][identify][long]") {
  const SkinScene all = skin_that_reads(three_stresses);
  const lab::Survey told = lab::identify(all);
  CHECK(lab::hidden_waves(told.own) == 0);
  CHECK(told.own.array->hidden == 0);
  REQUIRE(told.shares.size() == 3);
  CHECK(told.shares[0].signal[2] == 0.0);  // stress_x and the curl
  CHECK(told.shares[1].signal[1] == 0.0);  // k x = 1: no shear of the drag along the wave
  CHECK(told.shares[1].signal[2] > 0.0);
  CHECK(report::hidden_in_words(told).empty());

  const SkinScene pressure = skin_that_reads("\"stress_x\"", "depths = [1.0, 1.5]");
  const lab::Survey blind = lab::identify(pressure);
  const auto words = report::verdict_in_words(blind);
  CHECK(says(words, "The curl of q is seen by no depth of stress_x"));
  CHECK(says(words, "What is uniform of the drag q_y and the drag q_z"));
  CHECK(says(words, "no drag across it (the curl)"));
  CHECK_FALSE(blind.own.resolvable(SkinRipple::drag_across));
  CHECK(blind.own.resolvable(SkinRipple::pressure));
  // The advice reads more than one quantity, and shows every wave.
  REQUIRE(blind.advice.best);
  CHECK(lab::hidden_waves(blind.alternatives[*blind.advice.best]) == 0);

  // The three normal stresses show drags along waves of any direction, but by the ends alone the
  // curl of waves along y and z.
  const SkinScene normal = skin_that_reads("\"stress_x\", \"stress_y\", \"stress_z\"");
  const lab::Survey half = lab::identify(normal);
  CHECK(says(report::verdict_in_words(half), "The curl of q of waves along y"));
  CHECK(says(report::verdict_in_words(half), "only at the ends of the skin"));
  CHECK(half.own.array->boundary_only > 0);
}

TEST_CASE("the narrowest circle that is seen causes just the noise, by the exact model",
          "[lab][skin][identify][long]") {
  const Material pad{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  Material layer = pad;
  layer.layer = Layer{.thickness = 2.5};
  for (const Material& material : {pad, layer})
    for (const std::vector<Quantity>& reads :
         {std::vector{Quantity::stress_x}, std::vector{Quantity::shear_xy, Quantity::shear_xz}}) {
      const SkinArray skin{
          .rows = 6, .columns = 5, .pitch_y = 1.0, .pitch_z = 1.4, .depths = {0.7}, .reads = reads};
      const std::vector<double> rms(reads.size(), 0.02);
      const auto width = lab::skin_unseen_width(skin, material, rms, {}, 1.0);
      REQUIRE(width);
      const auto hole = lab::widest_hole(skin, {});
      REQUIRE(hole);
      const auto largest = [&](double share, double radius) {
        // From the hole to the taxel next to it, which is at (0.5, 0) or its mirror.
        const double to_y = hole->y + (hole->y > 0.0 ? 0.5 : -0.5);
        const double to_z = hole->z > 0.0 ? 0.0 : hole->z + 0.7;
        const SkinLoad circle{SkinContact{.y = std::lerp(hole->y, to_y, share),
                                          .z = std::lerp(hole->z, to_z, share),
                                          .radius = radius,
                                          .force = 2.0 / 3.0 * std::numbers::pi * radius * radius}};
        double most = 0.0;
        for (const double reading : exact_readings(skin, material, std::span(&circle, 1)))
          most = std::max(most, std::abs(reading));
        return most;
      };
      double least = 1.0;
      for (const double share : {0.0, 0.5, 1.0})
        least = std::min(least, largest(share, 0.5 * *width));
      CAPTURE(name(reads.front()), *width, least);
      CHECK_THAT(least, WithinRel(0.02, 0.02));
    }
}

TEST_CASE("the widest hole is where taxels are missing", "[lab][skin][identify][long]") {
  const SkinArray even{.rows = 4,
                       .columns = 4,
                       .pitch_y = 1.0,
                       .pitch_z = 1.0,
                       .depths = {1.0},
                       .reads = {Quantity::stress_x}};
  const auto middle = lab::widest_hole(even, {});
  REQUIRE(middle);
  CHECK_THAT(middle->y, WithinAbs(0.0, 1e-12));
  CHECK_THAT(middle->z, WithinAbs(0.0, 1e-12));
  const std::array<std::size_t, 1> dead{5};
  const auto there = lab::widest_hole(even, dead);
  REQUIRE(there);
  CHECK_THAT(there->y, WithinAbs(-0.5, 1e-12));
  CHECK_THAT(there->z, WithinAbs(-0.5, 1e-12));
  // An angle of taxels: its empty corner is not among them.
  std::vector<Taxel> taxels;
  for (int i = 0; i < 6; ++i) {
    taxels.push_back({"a" + std::to_string(i), 1.0 * i, 0.0, 1.0, {Quantity::stress_x}});
    if (i > 0) taxels.push_back({"b" + std::to_string(i), 0.0, 1.0 * i, 1.0, {Quantity::stress_x}});
  }
  const auto inside = lab::widest_hole(uneven_skin(taxels), {});
  REQUIRE(inside);
  CHECK(inside->y + inside->z <= 5.0 + 1e-9);
  CHECK_FALSE(lab::widest_hole(
      SkinArray{.rows = 1, .columns = 1, .depths = {1.0}, .reads = {Quantity::stress_x}}, {}));
}

TEST_CASE("a survey of a skin knows no units", "[lab][skin][identify][long]") {
  const SkinScene one =
      skin_that_reads(three_stresses, "depth = 1.0", "[dead_taxels]\nindices = [0]\n");
  SkinScene large = one;
  const double metre = 1e3;
  const double pascal = 1e-6;
  large.sensor.pitch_y *= metre;
  large.sensor.pitch_z *= metre;
  large.sensor.depths[0] *= metre;
  large.material.youngs_modulus *= pascal;
  for (auto& [quantity, rms] : large.noise->rms) rms *= pascal;
  auto& contact = std::get<SkinContact>(large.contacts[0]);
  contact.radius *= metre;
  contact.force *= pascal * metre * metre;
  const lab::Survey a = lab::identify(one);
  const lab::Survey b = lab::identify(large);
  CHECK(a.own.array->dead > 0);
  CHECK(a.own.array->dead == b.own.array->dead);
  REQUIRE(a.alternatives.size() == b.alternatives.size());
  CHECK_THAT(*b.own.unseen, WithinRel(metre * *a.own.unseen, 1e-3));
  for (std::size_t i = 0; i < a.alternatives.size(); ++i)
    for (const SkinRipple ripple : lab::ripples_of(a.alternatives[i].unknowns)) {
      const auto of_a = a.alternatives[i].resolvable(ripple);
      const auto of_b = b.alternatives[i].resolvable(ripple);
      REQUIRE(of_a.has_value() == of_b.has_value());
      if (of_a) CHECK_THAT(*of_b, WithinRel(metre * *of_a, 1e-9));
    }
}

TEST_CASE("more noise hides more ripples, and what is asked is checked",
          "[lab][skin][identify][long]") {
  const SkinScene scene = skin_that_reads(three_stresses);
  double before = 0.0;
  for (const double noise : {0.001, 0.05, 0.3}) {
    const lab::Survey survey = lab::identify(scene, {.relative_noise = noise});
    const double now = lab::coarsest(survey.own);
    CHECK(now >= before);
    before = now;
  }
  CHECK(before > 2.0);
  CHECK_THROWS_AS(lab::identify(scene, {.traction = -1.0}), std::invalid_argument);
  SkinScene empty = scene;
  empty.contacts.clear();
  CHECK(lab::needs_traction(empty, {}));
  CHECK_THROWS_AS(lab::identify(empty), std::invalid_argument);
  // As strong as recorded readings: of the longest wave, k depth = 1, stress_x has 2/e of p.
  const std::array largest{2.0, 0.1, 0.1};
  CHECK_THAT(lab::traction_behind(empty, largest), WithinRel(std::numbers::e, 1e-9));
  CHECK_THROWS_AS(lab::traction_behind(empty, std::array{0.0, 0.0, 0.0}), std::invalid_argument);
}
