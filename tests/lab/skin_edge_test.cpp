#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// A sphere on 8 x 8 taxels, which reach from -7 to 7.
SkinScene touched_skin(double y, double z, double radius, const std::string& more = "") {
  const double force = 2.0 * std::numbers::pi * radius * radius;  // the largest pressure is 3
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 8\ncolumns = 8\npitch = 2.0\ndepth = 2.0\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 250.0\npoisson_ratio = 0.48\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [" +
          std::to_string(y) + ", " + std::to_string(z) + "]\nradius = " + std::to_string(radius) +
          "\nforce = " + std::to_string(force) + "\nfriction = 0.4\ndirection = 40.0\n" + more,
      "skin.toml"));
}

/// With noise of a share of the largest reading.
SkinScene with_noise(SkinScene scene, double share, std::uint64_t seed) {
  double peak = 0.0;
  for (const double reading : lab::simulate(scene).readings)
    peak = std::max(peak, std::abs(reading));
  scene.noise = NoiseModel{.rms = {}, .seed = seed};
  for (const Quantity quantity : scene.sensor.reads) scene.noise->rms[quantity] = share * peak;
  return scene;
}

/// The largest error of force and centre over their deviations.
double off(const lab::Experiment& experiment) {
  const UncertainWrench& found = experiment.results.front().answer.wrench;
  const auto centre = *experiment.frame.wrench.centre();
  const auto times = [](const Uncertain& one, double exact) {
    return std::abs(one.value - exact) / one.deviation;
  };
  return std::max({times(found.normal, experiment.frame.wrench.force[0]),
                   times(*found.centre_y, centre.y), times(*found.centre_z, centre.z)});
}

}  // namespace

TEST_CASE("deviations hold what presses over the edge of a skin", "[lab][skin][edge][long]") {
  // Centred beyond the last taxels, where a grid that ends with them was 8 and 37 deviations off.
  for (const auto& [y, z] : {std::pair{8.5, 0.0}, std::pair{8.9, 8.9}}) {
    const lab::Experiment found = lab::run(with_noise(touched_skin(y, z, 3.0), 0.01, 1));
    REQUIRE(found.results.front().has_answer());
    CAPTURE(y, z, found.results.front().answer.unseen);
    CHECK(found.results.front().answer.unseen > lab::most_unseen);
    CHECK(off(found) < 4.0);
    // The outermost taxels are pressed as hard as any, and the answer says so.
    CHECK(found.results.front().answer.verdict == lab::Verdict::cut_off);
    const std::vector<std::string> warnings =
        report::remarks_in_words(found.results.front().answer).warnings;
    CHECK(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("lies beyond the taxels") != std::string::npos;
    }));
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int held = 0;
  constexpr int frames = 12;
  for (int i = 0; i < frames; ++i) {
    const double along = 9.0 * unit(random);
    const double across = (i % 4 < 2 ? 1.0 : -1.0) * (7.5 + unit(random));
    const std::string constraint = i % 3 == 0 ? "[reconstruct]\nfriction_limit = 0.8\n" : "";
    const lab::Experiment found =
        lab::run(with_noise(touched_skin(i % 2 ? along : across, i % 2 ? across : along,
                                         2.5 + unit(random), constraint),
                            i % 2 ? 0.01 : 0.001, static_cast<std::uint64_t>(i + 1)));
    REQUIRE(found.results.front().has_answer());
    held += off(found) < 2.0;
    CHECK(off(found) < 4.0);
  }
  CHECK(held >= 10);
}

TEST_CASE("deviations hold what presses where taxels are dead", "[lab][skin][edge][long]") {
  std::string dead;
  for (int i = 0; i < 40; ++i) dead += (i > 0 ? ", " : "") + std::to_string(i);
  for (const double y : {-1.0, 1.0}) {
    const lab::Experiment found = lab::run(with_noise(
        touched_skin(y, 1.0, 2.5, "[dead_taxels]\nindices = [" + dead + "]\n"), 0.01, 1));
    REQUIRE(found.results.front().has_answer());
    CAPTURE(y, found.results.front().answer.wrench.normal.value,
            found.results.front().answer.wrench.normal.deviation);
    CHECK(off(found) < 4.0);
  }
}

TEST_CASE("what is seen is what lies near a live taxel", "[lab][skin][edge][long]") {
  const SkinScene scene = touched_skin(0.0, 0.0, 2.0, "[dead_taxels]\nindices = [27]\n");
  const lab::SkinSceneProblem problem(scene);
  const std::vector<bool>& unseen = problem.unseen();
  const SurfaceGrid& grid = problem.grid();
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const double y = grid.y(i / grid.columns);
    const double z = grid.z(i % grid.columns);
    const bool outside = std::max(std::abs(y), std::abs(z)) > 7.0 + 1.5;
    if (outside) CHECK(unseen[i]);
    // The dead one's place too (row 3, column 3), which others stand around.
    if (std::max(std::abs(y), std::abs(z)) <= 7.0) CHECK_FALSE(unseen[i]);
  }
  CHECK(lab::unseen_share(std::vector{1.0, 3.0, -2.0}, std::vector<std::size_t>{0, 1, 2},
                          {false, true, true}) == 0.75);
}

TEST_CASE("a friction limit below the true one is doubted, an honest one is not",
          "[lab][skin][data][long]") {
  const auto data = [](const std::string& limit) {
    const SkinScene scene = with_noise(touched_skin(1.0, 0.5, 3.0, limit), 0.01, 2);
    return *lab::run(scene).results.front().answer.data;
  };
  CHECK(data("").consistent());
  CHECK(data("[reconstruct]\nfriction_limit = 0.8\n").consistent());
  const DataVerdict low = data("[reconstruct]\nfriction_limit = 0.1\n");
  CHECK_FALSE(low.consistent());
  CHECK(low.residual_rms > low.residual_limit);
}

TEST_CASE("a radius by Hertz' law holds the true one, and is not named where there is none",
          "[lab][skin][edge][long]") {
  const auto said = [](const lab::Experiment& experiment) {
    std::string text;
    for (const auto& row : report::found_cells(experiment))
      for (const std::string& cell : row) text += cell + "|";
    return text;
  };
  const SkinScene sphere = with_noise(touched_skin(1.0, 0.5, 3.0), 0.01, 2);
  const lab::Experiment found = lab::run(sphere);
  REQUIRE(found.results.front().answer.ellipse);
  CHECK(std::abs(found.results.front().answer.ellipse->radius.value - 3.0) <
        2.5 * found.results.front().answer.ellipse->radius.deviation);
  CHECK_THAT(said(found), ContainsSubstring("radius (Hertz)") && ContainsSubstring("|3|"));
  SkinScene punch = sphere;
  std::get<SkinContact>(punch.contacts[0]).shape = SkinShape::punch;
  CHECK(said(lab::run(punch)).find("radius") == std::string::npos);
}

TEST_CASE("force and centre of a skin know no units", "[lab][skin][edge][long]") {
  const SkinScene one = with_noise(touched_skin(1.0, 0.5, 3.0), 0.01, 2);
  const lab::Experiment here = lab::run(one);
  for (const double metre : {1e-150, 1e150})
    for (const double pascal : {1.0, 1e-5}) {
      SkinScene other = one;
      other.sensor.pitch_y *= metre;
      other.sensor.pitch_z *= metre;
      other.sensor.depths[0] *= metre;
      other.material.youngs_modulus *= pascal;
      for (auto& [quantity, rms] : other.noise->rms) rms *= pascal;
      // Its own readings, which are the same numbers but for the pressure.
      std::vector<double> readings = here.frame.readings;
      for (double& reading : readings) reading *= pascal;
      const lab::FrameAnswer there = lab::solve(lab::SkinSceneProblem(other), readings);
      CAPTURE(metre, pascal);
      REQUIRE(there.wrench.centre_y);
      CHECK_THAT(there.wrench.centre_y->value / metre,
                 WithinRel(here.results.front().answer.wrench.centre_y->value, 1e-6));
      CHECK_THAT(there.wrench.centre_y->deviation / metre,
                 WithinRel(here.results.front().answer.wrench.centre_y->deviation, 1e-6));
      CHECK_THAT(there.wrench.normal.value / metre / metre / pascal,
                 WithinRel(here.results.front().answer.wrench.normal.value, 1e-6));
      CHECK_THAT(there.wrench.normal.deviation / metre / metre / pascal,
                 WithinRel(here.results.front().answer.wrench.normal.deviation, 1e-6));
    }
}
