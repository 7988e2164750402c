// Where deviations hold, and answers that were wrong and said ok.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lab/skin_data_verdict.hpp"
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

/// A sphere that presses with 1 on 8 x 8 taxels, which reach from -7 to 7; up to 47 of stress_x.
SkinScene pressed_skin(double y, double z, const std::string& more = "",
                       const std::string& size = "8") {
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = " + size + "\ncolumns = " + size +
          "\npitch = 2.0\ndepth = 2.0\nreads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
          "[material]\nyoungs_modulus = 250.0\npoisson_ratio = 0.48\n"
          "[[contact]]\nshape = \"sphere\"\nplace = [" +
          std::to_string(y) + ", " + std::to_string(z) +
          "]\nradius = 3.0\nforce = 1000.0\n[noise]\nrms = 0.2\n" + more,
      "skin.toml"));
}

lab::FrameAnswer answer_of_skin(const SkinScene& scene) {
  lab::Experiment found = lab::run(scene);
  REQUIRE(found.results.front().has_answer());
  return std::move(found.results.front().answer);
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

TEST_CASE("what presses beyond all taxels is cut off, whatever alpha says", "[lab][skin][edge]") {
  for (const double y : {9.0, 10.0, 11.0, 12.0})
    for (const char* more : {"", "[reconstruct]\nnonnegative = true\n"}) {
      CAPTURE(y, more);
      CHECK(answer_of_skin(pressed_skin(y, 2.0, more)).verdict == lab::Verdict::cut_off);
    }
  // Half of it dead, a contact in the middle of that.
  SkinScene scene = pressed_skin(4.0, 0.0, "[reconstruct]\nnonnegative = true\n");
  for (std::size_t taxel = 32; taxel < 64; ++taxel) scene.dead_taxels.push_back(taxel);
  CHECK(answer_of_skin(scene).verdict == lab::Verdict::cut_off);
  // Nothing at all presses: nothing is cut off.
  scene.contacts.clear();
  scene.reconstruct.tangential = false;
  CHECK(answer_of_skin(scene).verdict != lab::Verdict::cut_off);
}

TEST_CASE("the place of a contact of one row of cells is not certain", "[lab][skin]") {
  const SurfaceGrid grid = grid_of(pressed_skin(0.0, 0.0).sensor, {});
  const std::vector<std::size_t> column = {grid.columns + 2, 2 * grid.columns + 2};
  const std::vector<std::size_t> row = {3, 4, 5};
  CHECK(is_one_line(grid, column, true));
  CHECK_FALSE(is_one_line(grid, column, false));
  CHECK(is_one_line(grid, row, false));
  CHECK(with_neighbours(grid, std::vector<std::size_t>{0}) ==
        std::vector<std::size_t>{0, 1, grid.columns, grid.columns + 1});

  // Clipped, and taken for what they say: constraints leave one column.
  SkinScene scene = pressed_skin(1.0, -1.5, "[reconstruct]\nnonnegative = true\n");
  std::vector<double> readings = lab::simulate(scene).readings;
  for (double& reading : readings) reading = std::clamp(reading, -3.0, 3.0);
  scene.noise.reset();  // or all that could explain them is sought
  scene.reconstruct.alpha = 2.32e-6;
  const lab::FrameAnswer answer = lab::solve(lab::SkinSceneProblem(scene), readings);
  std::vector<std::size_t> pressed;
  for (const std::size_t cell : answer.cells)
    if (answer.tractions[cell] != 0.0) pressed.push_back(cell);
  REQUIRE_FALSE(pressed.empty());
  CAPTURE(pressed);
  REQUIRE(is_one_line(grid, pressed, true));
  REQUIRE(answer.wrench.centre_z);
  CHECK(answer.wrench.centre_z->deviation >= grid.spacing_z / std::sqrt(12.0));
  CHECK(answer.wrench.centre_y->deviation > 0.0);
}

TEST_CASE("taxels more than two depths apart leave too much to guess", "[lab][skin]") {
  SkinScene scene = pressed_skin(1.0, -1.5, "[reconstruct]\ntangential = false\n", "6");
  scene.sensor.pitch_y = scene.sensor.pitch_z = 4.0;
  CHECK(answer_of_skin(scene).verdict == lab::Verdict::ok);
  scene.sensor.pitch_y = 5.0;
  CHECK(answer_of_skin(scene).verdict == lab::Verdict::coarse);
}

TEST_CASE("the force of a narrow contact is held wherever it lies between taxels",
          "[lab][skin][bands]") {
  const double apart = GENERATE(1.5, 1.7, 2.0);  // in depths
  const double radius = GENERATE(0.2, 0.6);
  const double pitch = 2.0 * apart;
  SkinScene scene = pressed_skin(0.0, 0.0, "[reconstruct]\ntangential = false\n", "7");
  scene.sensor.pitch_y = scene.sensor.pitch_z = pitch;
  scene.sensor.reads = {Quantity::stress_x};
  for (const auto& [y, z] : {std::pair(0.0, 0.0), std::pair(0.5, 0.0), std::pair(0.5, 0.25),
                             std::pair(0.25, 0.25), std::pair(0.5, 0.5)}) {
    scene.contacts = pressed_skin(y * pitch, z * pitch).contacts;
    std::get<SkinContact>(scene.contacts.front()).radius = radius;
    const lab::FrameAnswer answer = answer_of_skin(scene);
    CAPTURE(apart, radius, y, z, name(answer.verdict), answer.wrench.normal.value,
            answer.wrench.normal.deviation);
    CHECK(std::abs(answer.wrench.normal.value - 1000.0) <= 2.0 * answer.wrench.normal.deviation);
  }
}
