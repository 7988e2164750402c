#include "tactile_net/lab/recording_row.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

/// One recording of ten frames, sound but for what is changed.
RecordingRow sound(const std::string& name) {
  return {.name = name,
          .frames = 10,
          .faultless = 10,
          .verdict = Verdict::ok,
          .force = Uncertain{2.0, 0.1}};
}

RecordingRow changed(const std::string& name, const auto& change) {
  RecordingRow row = sound(name);
  change(row);
  return row;
}

}  // namespace

TEST_CASE("recordings are sorted by suspicion, wherever they stood before", "[lab][report]") {
  using Row = RecordingRow;
  const std::vector<RecordingRow> expected = {
      changed("unread", [](Row& row) { row = {.name = "unread", .problem = "no such file"}; }),
      changed("faults", [](Row& row) { row.faultless = 3; }),
      changed("fewer faults", [](Row& row) { row.faultless = 5; }),
      changed("two findings",
              [](Row& row) {
                row.findings = {finding::NoFrames{}, finding::NoFrames{}};
              }),
      changed("a finding", [](Row& row) { row.findings = {finding::NoFrames{}}; }),
      changed("a frame at fault", [](Row& row) { row.faultless = 9; }),
      changed("doubted", [](Row& row) { row.doubted = 1; }),
      changed("force unknown", [](Row& row) { row.force.reset(); }),
      changed("unsure", [](Row& row) { row.force->deviation = 1.0; }),
      changed("harder",
              [](Row& row) {
                row.force = {4.0, 0.2};
              }),
      sound("a"),
      sound("b")};
  CHECK(expected[0].standing() == Standing::no_answer);
  for (std::size_t i = 1; i < expected.size(); ++i) {
    CAPTURE(expected[i].name);
    CHECK(expected[i].standing() == (i < 5 ? Standing::needs_a_look : Standing::fine));
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t k = 0; k < expected.size(); ++k) {
      CAPTURE(expected[i].name, expected[k].name);
      CHECK(is_more_suspicious(expected[i], expected[k]) == (i < k));
    }
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<RecordingRow> rows = expected;
    std::shuffle(rows.begin(), rows.end(), random);
    sort_by_suspicion(rows);
    CHECK(std::equal(rows.begin(), rows.end(), expected.begin(),
                     [](const Row& a, const Row& b) { return a.name == b.name; }));
  }
}

TEST_CASE("a row counts every frame of its recording, and takes the one that presses hardest",
          "[lab][report]") {
  const auto scene = std::get<SkinScene>(
      parse_any_scene("[sensor]\nrows = 2\ncolumns = 2\npitch = 1.0\ndepth = 1.0\n"
                      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
                      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                      "[reconstruct]\nfriction_limit = 0.5\n",
                      "skin.toml"));
  const SkinSceneProblem problem(scene);
  Recording recording{AnyProblem(problem)};
  const auto told = [&] { return row_of(recording.overview()); };
  CHECK(told().standing() == Standing::no_answer);  // of no frame
  recording.skip(0.5);
  CHECK(told().standing() == Standing::no_answer);
  const std::vector<double> readings(12, 1.0);
  const auto add = [&](double time, double force, Verdict verdict, double drag) {
    FrameAnswer answer{.tractions = std::vector<double>(problem.tractions(), force),
                       .verdict = verdict};
    answer.wrench.normal = {force, 0.1};
    answer.friction = SkinFriction{.ratio = {drag, 0.01}};
    recording.add(time, problem, readings, answer);
  };
  add(1.0, 1.0, Verdict::ok, 0.1);
  add(1.5, 3.0, Verdict::no_contact, 9.0);  // what no frame with the verdict ok shows is no margin
  add(2.5, 2.0, Verdict::ok, 0.4);
  const RecordingRow row = told();
  CHECK(row.frames == 4);
  CHECK(row.faultless == 3);
  CHECK(row.verdict == Verdict::failed);
  REQUIRE(row.force);
  CHECK(row.force->value == 2.0);  // what presses harder is not to be trusted
  CHECK(row.force_frame == 3U);
  CHECK(row.force_time == 2.5);
  CHECK(row.duration == 2.0);
  REQUIRE(row.slip_margin);
  CHECK_THAT(*row.slip_margin, WithinAbs(0.2, 1e-12));
  CHECK(row.standing() == Standing::needs_a_look);  // a quarter has no answer
}

}  // namespace tactile_net::lab
