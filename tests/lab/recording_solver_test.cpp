#include "tactile_net/lab/recording_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <variant>
#include <vector>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net::lab {
namespace {

Scene pressed_over_time() {
  return parse_scene(
      "[sensor]\ncount = 17\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1e3\npoisson_ratio = 0.45\n[noise]\nrms = 0.01\n"
      "[time]\nrate = 10.0\nframes = 6\n[reconstruct]\nalpha = 1e-3\n"
      "[[contact]]\nshape = \"cylinder\"\nforce = 10.0\nhalf_width = 2.0\n",
      "scene.toml");
}

std::vector<double> simulated_readings(const Scene& scene) { return simulate(scene).readings; }

struct Steps : Observer {
  explicit Steps(std::size_t most) : most_(most) {}
  void step(const Step& step) override {
    frames.push_back(step.count);
    if (frames.size() == most_) throw std::runtime_error("enough");
  }
  std::vector<std::size_t> frames{};

 private:
  std::size_t most_;
};

}  // namespace

TEST_CASE("frames are solved as the method solves them, and judged", "[lab][recording]") {
  const Scene scene = pressed_over_time();
  const SceneProblem problem(scene);
  RecordingSolver recorded(problem, Method::tikhonov);
  const auto alone = make_solver(problem, Method::tikhonov);
  std::vector<double> found(recorded.tractions());
  std::vector<double> expected(alone->tractions());
  SensorRecording sensor(scene);
  while (sensor.next()) {
    std::vector<double> readings(sensor.readings().begin(), sensor.readings().end());
    const auto result = recorded.solve(readings, found);
    REQUIRE(result);
    REQUIRE(alone->solve(sensor.readings(), expected).status == FrameStatus::ok);
    CHECK(found == expected);
    REQUIRE(result->data);
    CHECK(result->data->consistent());
  }
  CHECK(recorded.solved().frames == 6);
  CHECK(recorded.solved().verdicts.size() == 1);
}

TEST_CASE("a frame with a missing reading is skipped, or solved from the others",
          "[lab][recording]") {
  const Scene scene = pressed_over_time();
  std::vector<double> readings = simulated_readings(scene);
  readings[4] = missing_reading;
  const Missing missing = GENERATE(Missing::skip, Missing::estimate);
  RecordingSolver solver(SceneProblem(scene), Method::tikhonov, {.missing = missing});
  std::vector<double> tractions(solver.tractions(), 7.0);
  const auto result = solver.solve(readings, tractions);
  CHECK(result.has_value() == (missing == Missing::estimate));
  CHECK(solver.solved().frames == 1);
  if (result) {
    CHECK(solver.problem().scene().dead_taxels == std::vector<std::size_t>{4});
    CHECK(solver.solved().estimated.count() == 1);
  } else {
    CHECK(tractions == std::vector<double>(solver.tractions(), 7.0));
    CHECK(solver.solved().skipped.count() == 1);
  }
  std::vector<double> whole = simulated_readings(scene);
  REQUIRE(solver.solve(whole, tractions));
  CHECK(solver.problem().scene().dead_taxels.empty());
}

TEST_CASE("a bad frame does not count", "[lab][recording]") {
  RecordingSolver solver(SceneProblem(pressed_over_time()), Method::tikhonov);
  std::vector<double> tractions(solver.tractions(), 7.0);
  std::vector<double> readings(17, 1.0);
  readings[3] = missing_reading;
  const auto result = solver.solve(readings, tractions);
  REQUIRE(result);
  CHECK(result->status == FrameStatus::not_finite);
  CHECK(solver.solved().frames == 0);
  CHECK(tractions == std::vector<double>(solver.tractions(), 7.0));
}

TEST_CASE("whoever observes a simulation hears every frame, and may end it", "[lab][recording]") {
  Steps all(100);
  (void)simulate(pressed_over_time(), all);
  CHECK(all.frames == std::vector<std::size_t>{0, 1, 2, 3, 4, 5});
  Steps some(3);
  CHECK_THROWS(simulate(pressed_over_time(), some));
  CHECK(some.frames.size() == 3);
}

TEST_CASE("taxels at the end of a line's range are left out, as if dead",
          "[lab][recording][clipped]") {
  Scene scene = pressed_over_time();
  std::vector<double> readings = simulated_readings(scene);
  const double limit = 0.7 * *std::max_element(readings.begin(), readings.end());
  std::vector<std::size_t> beyond;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (readings[i] >= limit) beyond.push_back(i);
  REQUIRE(beyond.size() >= 5);
  for (double& reading : readings) reading = std::min(reading, limit);

  // Nobody states the range: they are named, and taken for what they say.
  const std::vector<double> clipped = readings;
  RecordingSolver guessing(SceneProblem(scene), Method::tikhonov);
  std::vector<double> found(guessing.tractions());
  auto result = guessing.solve(readings, found);
  REQUIRE(result);
  CHECK(result->verdict == Verdict::clipped);
  CHECK(readings == clipped);
  REQUIRE(std::holds_alternative<remark::Clipped>(result->remarks.back()));
  CHECK(std::get<remark::Clipped>(result->remarks.back()).taxels == beyond);
  CHECK_FALSE(std::get<remark::Clipped>(result->remarks.back()).left_out);

  scene.saturation = Saturation{.range = {{Quantity::stress_x, {-limit, limit}}}};
  RecordingSolver knowing(SceneProblem(scene), Method::tikhonov);
  result = knowing.solve(readings, found);
  REQUIRE(result);
  CHECK(result->verdict == Verdict::clipped);
  CHECK(std::get<remark::Clipped>(result->remarks.back()).left_out);
  CHECK(knowing.solved().estimated.count() == 0);
  scene.dead_taxels = beyond;
  const auto without = make_solver(scene, Method::tikhonov);
  std::vector<double> expected(without->tractions());
  REQUIRE(without->solve(readings, expected).status == FrameStatus::ok);
  CHECK(found == expected);
}

}  // namespace tactile_net::lab
