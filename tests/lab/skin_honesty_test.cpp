// Answers that were wrong, and said ok.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lab/skin_data_verdict.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

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

const lab::remark::Clipped* clipped_of(const lab::FrameAnswer& answer) {
  for (const lab::Remark& remark : answer.remarks)
    if (const auto* found = std::get_if<lab::remark::Clipped>(&remark)) return found;
  return nullptr;
}

/// Taxels of which a reading is beyond a limit.
std::vector<std::size_t> beyond(const SkinScene& scene, double limit) {
  const std::vector<double> readings = lab::simulate(scene).readings;
  const lab::SkinSceneProblem problem(scene);
  std::vector<std::size_t> taxels;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (std::abs(readings[i]) >= limit) taxels.push_back(problem.problem().sites[i].taxel);
  std::sort(taxels.begin(), taxels.end());
  taxels.erase(std::unique(taxels.begin(), taxels.end()), taxels.end());
  return taxels;
}

}  // namespace

TEST_CASE("a skin that nothing presses has no fault", "[lab][skin][verdict]") {
  SkinScene scene = pressed_skin(0.0, 0.0);
  scene.contacts.clear();
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    scene.noise->seed = seed;
    const lab::FrameAnswer answer = answer_of_skin(scene);
    CAPTURE(seed, name(answer.verdict));
    REQUIRE(answer.data->noise_alone);
    CHECK(is_faultless(answer.verdict));
  }
}

TEST_CASE("taxels at the end of a skin's range are left out and named", "[lab][skin][clipped]") {
  const SkinScene honest = pressed_skin(1.0, -1.5);
  SkinScene scene = honest;
  scene.saturation.emplace();
  for (const Quantity quantity : scene.sensor.reads)
    scene.saturation->range[quantity] = {-5.0, 5.0};
  const lab::FrameAnswer answer = answer_of_skin(scene);
  CHECK(answer.verdict == lab::Verdict::clipped);
  const lab::remark::Clipped* clipped = clipped_of(answer);
  REQUIRE(clipped);
  CHECK(clipped->left_out);
  CHECK(clipped->taxels == beyond(honest, 5.0));
  REQUIRE(clipped->names.size() == clipped->taxels.size());
  for (std::size_t i = 0; i < clipped->names.size(); ++i)
    CHECK(clipped->names[i] == taxel_name(scene.sensor, clipped->taxels[i]));
  // Taken for what they say they make it 0.3 of that, or less.
  CHECK(answer.wrench.normal.value > 600.0);
  CHECK(answer.wrench.normal.value < 1300.0);

  // As if they were listed as dead.
  SkinScene dead = honest;
  dead.dead_taxels = clipped->taxels;
  CHECK(answer.tractions == answer_of_skin(dead).tractions);

  scene.saturation->range[Quantity::stress_x] = {-500.0, 500.0};
  scene.saturation->range[Quantity::shear_xy] = {-500.0, 500.0};
  scene.saturation->range[Quantity::shear_xz] = {-500.0, 500.0};
  CHECK(answer_of_skin(scene).verdict == lab::Verdict::ok);
}

TEST_CASE("readings that pile up at one value are no honest skin's", "[lab][skin][clipped]") {
  SkinScene scene = pressed_skin(1.0, -1.5);
  std::vector<double> readings = lab::simulate(scene).readings;
  scene.noise.reset();  // which doubts them itself
  const lab::SkinSceneProblem problem(scene);
  CHECK_FALSE(clipped_of(lab::solve(problem, readings)));
  for (double& reading : readings) reading = std::clamp(reading, -3.0, 3.0);
  const lab::FrameAnswer answer = lab::solve(problem, readings);
  CHECK(answer.verdict == lab::Verdict::clipped);
  REQUIRE(clipped_of(answer));
  CHECK_FALSE(clipped_of(answer)->left_out);
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

TEST_CASE("a converter's steps are noise that is known", "[lab][skin][noise]") {
  SkinScene scene = pressed_skin(1.0, -1.5);
  const double alone = *lab::SkinSceneProblem(scene).stated_noise();
  CHECK(alone == 0.2);
  scene.quantization = Quantization{.bits = 4, .range = {}};
  for (const Quantity quantity : scene.sensor.reads)
    scene.quantization->range[quantity] = {-150.0, 150.0};
  const double step = 300.0 / 15.0;
  CHECK(std::abs(*lab::SkinSceneProblem(scene).stated_noise() -
                 std::hypot(0.2, step / std::sqrt(12.0))) < 1e-12);
  // So are those of readings that are weighted each by its own.
  scene.noise->weights_rows = true;
  CHECK(*lab::SkinSceneProblem(scene).stated_noise() == 1.0);
  const lab::SkinSceneProblem weighted(scene);
  CHECK(std::abs(weighted.problem().weights.front() * std::hypot(0.2, step / std::sqrt(12.0)) -
                 1.0) < 1e-12);
}
