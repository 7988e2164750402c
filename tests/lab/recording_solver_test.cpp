#include "tactile_net/lab/recording_solver.hpp"

#include <optional>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/checked_line.hpp"
#include "tests/lab/checked_skin.hpp"
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

constexpr double slope = 0.3 * pad_noise;  // a frame

template <class Recording>
void let_drift(Recording& recording) {
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    for (double& value : recording.frames[k]) value += slope * static_cast<double>(k);
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

namespace {

/// Which drifts, and of which a reading is missing.
template <class Recording>
Recording drifting() {
  Recording recording;
  if constexpr (std::is_same_v<Recording, RecordedLine>) {
    recording = recorded_line(line_pad(11, "\"stress_x\"", presses, 1));
  } else {
    recording = recorded_skin(skin_pad("\"stress_x\"", false));
    std::vector<std::vector<double>> third;  // which are quick to solve
    for (std::size_t k = 0; k < recording.frames.size(); k += 3)
      third.push_back(recording.frames[k]);
    recording.frames = std::move(third);
  }
  let_drift(recording);
  recording.frames[30][4] = missing_reading;
  return recording;
}

AnyProblem problem_of(const RecordedLine& recording) { return SceneProblem(recording.scene); }
AnyProblem problem_of(const RecordedSkin& recording) { return SkinSceneProblem(recording.scene); }

}  // namespace

TEMPLATE_TEST_CASE(
    "a solver finds in frames and their times what a check of them finds, however many at once",
    "[lab][recording][check]", RecordedLine, RecordedSkin) {
  const Missing missing = GENERATE(Missing::skip, Missing::estimate);
  const auto recording = drifting<TestType>();
  const std::size_t frames = recording.frames.size();
  const auto time_of = [&](std::size_t k) -> std::optional<double> {
    // It is missing once, runs backwards once and stands still once.
    if (k == 10) return std::nullopt;
    const std::size_t half = frames / 2;
    const std::size_t steps = k < half ? k : k < half + 20 ? k - half / 2 : k - half / 2 - 1;
    return 0.01 * static_cast<double>(steps);
  };
  ReadingsChecker checker(recording.scene);
  for (std::size_t k = 0; k < frames; ++k) checker.add(time_of(k), recording.frames[k]);
  const ReadingsCheck expected = checker.result();
  const Names names = kinds(expected);
  for (const char* one : {"time_backwards", "time_repeats", "values_missing", "drift"})
    CHECK(names.contains(one));
  const auto check_found = [&](auto solve) {
    RecordingSolver solver(problem_of(recording), Method::tikhonov, {.missing = missing});
    solve(solver);
    CHECK(in_sentences(solver.findings(), recording.scene) ==
          in_sentences(expected.findings, recording.scene));
    const Findings doubts = solver.doubts();
    REQUIRE(doubts.size() == 1);
    const auto& drift = std::get<finding::Drift>(doubts.front());
    // Of two rests in which nothing presses, the change is the drift's.
    CHECK_THAT(drift.largest, WithinRel(slope * static_cast<double>(drift.to - drift.from), 0.25));
    return drift.largest;
  };
  const double one_by_one = check_found([&](RecordingSolver& solver) {
    for (std::size_t k = 0; k < frames; ++k) {
      std::vector<double> readings = recording.frames[k];
      (void)solver.solve(readings, time_of(k));
    }
  });
  const double at_once = check_found([&](RecordingSolver& solver) {
    std::size_t next = 0;
    solver.solve_all(
        [&](std::vector<double>& readings, std::optional<double>& time) {
          if (next == frames) return false;
          time = time_of(next);
          readings = recording.frames[next++];
          return true;
        },
        [](std::span<const double>, const std::optional<FrameAnswer>&) {}, 2);
  });
  CHECK(one_by_one == at_once);
}

}  // namespace tactile_net::lab
