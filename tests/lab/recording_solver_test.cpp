#include "tactile_net/lab/recording_solver.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <variant>
#include <vector>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/checked_line.hpp"
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

/// Of the problem that the last frame was solved with.
const std::vector<std::size_t>& dead_of(const RecordingSolver& solver) {
  return std::get<SceneProblem>(solver.problem()).scene().dead_taxels;
}

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
  std::vector<double> expected(alone->tractions());
  SensorRecording sensor(scene);
  while (sensor.next()) {
    std::vector<double> readings(sensor.readings().begin(), sensor.readings().end());
    const auto result = recorded.solve(readings);
    REQUIRE(result);
    REQUIRE(alone->solve(sensor.readings(), expected).status == FrameStatus::ok);
    CHECK(result->tractions == expected);
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
  const auto result = solver.solve(readings);
  CHECK(result.has_value() == (missing == Missing::estimate));
  CHECK(solver.solved().frames == 1);
  if (result) {
    CHECK(dead_of(solver) == std::vector<std::size_t>{4});
    CHECK(readings[4] == 0.0);
    CHECK(solver.solved().estimated.count() == 1);
  } else {
    CHECK(solver.solved().skipped.count() == 1);
  }
  std::vector<double> whole = simulated_readings(scene);
  REQUIRE(solver.solve(whole));
  CHECK(dead_of(solver).empty());
}

TEST_CASE("a bad frame does not count", "[lab][recording]") {
  RecordingSolver solver(SceneProblem(pressed_over_time()), Method::tikhonov);
  std::vector<double> readings(17, 1.0);
  readings[3] = missing_reading;
  CHECK_THROWS_AS(solver.solve(readings), std::invalid_argument);
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = i % 2 == 0 ? 1.7e308 : -1.7e308;
  CHECK_THROWS_AS(solver.solve(readings), FrameOverflow);
  CHECK_THROWS_AS(solver.solve(std::span(readings).first(5)), std::invalid_argument);
  CHECK(solver.solved().frames == 0);
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
  auto result = guessing.solve(readings);
  REQUIRE(result);
  CHECK(result->verdict == Verdict::clipped);
  CHECK(readings == clipped);
  REQUIRE(std::holds_alternative<remark::Clipped>(result->remarks.back()));
  CHECK(std::get<remark::Clipped>(result->remarks.back()).taxels == beyond);
  CHECK_FALSE(std::get<remark::Clipped>(result->remarks.back()).left_out);

  scene.saturation = Saturation{.range = {{Quantity::stress_x, {-limit, limit}}}};
  RecordingSolver knowing(SceneProblem(scene), Method::tikhonov);
  result = knowing.solve(readings);
  REQUIRE(result);
  CHECK(result->verdict == Verdict::clipped);
  CHECK(std::get<remark::Clipped>(result->remarks.back()).left_out);
  CHECK(knowing.solved().estimated.count() == 0);
  scene.dead_taxels = beyond;
  const auto without = make_solver(scene, Method::tikhonov);
  std::vector<double> expected(without->tractions());
  REQUIRE(without->solve(readings, expected).status == FrameStatus::ok);
  CHECK(result->tractions == expected);
}

TEST_CASE("what solve notices comes from the same functions", "[lab][check]") {
  const double factor = GENERATE(1.0, -1.0, 1e-3);
  RecordedLine recording = recorded_line(line_pad(11, "\"stress_x\"", presses, 1));
  for (auto& frame : recording.frames)
    for (double& value : frame) value *= factor;
  const SceneProblem problem(recording.scene);
  const auto solver = make_solver(problem, Method::tikhonov);
  SolvingDoubts doubts(problem);
  std::vector<double> tractions(11);
  for (const auto& frame : recording.frames) {
    const auto result = solver->solve(frame, tractions);
    doubts.add(problem, frame, {.tractions = tractions, .alpha = *result.alpha});
  }
  Names names;
  for (const Finding& one : doubts.findings()) names.emplace(name(one));
  CHECK(names == (factor == 1.0    ? Names{}
                  : factor == -1.0 ? Names{"whole_pad_pulled"}
                                   : Names{"scale_by_1000"}));
}

namespace {

/// A recording whose frames are all solved.
RecordingSolver solver_through(const RecordedLine& recording) {
  RecordingSolver solver(SceneProblem(recording.scene), Method::tikhonov);
  for (std::vector<double> frame : recording.frames) REQUIRE(solver.solve(frame));
  return solver;
}

/// From frame to frame by a tenth of the noise.
void let_drift(RecordedLine& recording) {
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    for (double& value : recording.frames[k]) value += 0.1 * pad_noise * static_cast<double>(k);
}

}  // namespace

TEST_CASE("solve is told what no single frame shows", "[lab][check]") {
  const RecordedLine clean = recorded_line(line_pad(21, "\"stress_x\"", presses, 1));
  const auto doubts_of = [](const RecordedLine& recording) {
    Names names;
    for (const Finding& one : solver_through(recording).doubts()) names.emplace(name(one));
    return names;
  };
  CHECK(doubts_of(clean) == Names{});
  RecordedLine twins = clean;
  for (auto& frame : twins.frames) frame[12] = frame[11];
  CHECK(doubts_of(twins) == Names{"equal_readings"});
  RecordedLine drifting = clean;
  let_drift(drifting);
  const Findings doubts = solver_through(drifting).doubts();
  REQUIRE(doubts.size() == 1);
  REQUIRE(std::holds_alternative<finding::Drift>(doubts.front()));
  // What the check of the whole recording says of these.
  CHECK(std::get<finding::Drift>(doubts.front()).largest ==
        finding_of<finding::Drift>(check(drifting)).largest);
}

TEST_CASE("a solver finds in frames and their times what a check of them finds",
          "[lab][recording][check]") {
  const Missing missing = GENERATE(Missing::skip, Missing::estimate);
  RecordedLine recording = recorded_line(line_pad(11, "\"stress_x\"", presses, 1));
  let_drift(recording);
  recording.frames[30][4] = missing_reading;
  ReadingsChecker checker(recording.scene);
  RecordingSolver solver(SceneProblem(recording.scene), Method::tikhonov, {.missing = missing});
  for (std::size_t k = 0; k < recording.frames.size(); ++k) {
    std::optional<double> time;  // runs backwards once, stands still once, and is missing once
    if (k != 50) time = 0.01 * static_cast<double>(k < 200 ? k : k < 300 ? k - 100 : k - 101);
    checker.add(time, recording.frames[k]);
    std::vector<double> readings = recording.frames[k];
    (void)solver.solve(readings, time);
  }
  const ReadingsCheck expected = checker.result();
  const Names names = kinds(expected);
  for (const char* one : {"time_backwards", "time_repeats", "values_missing", "drift"})
    CHECK(names.contains(one));
  CHECK(in_sentences(solver.findings(), recording.scene) ==
        in_sentences(expected.findings, recording.scene));
}

}  // namespace tactile_net::lab
