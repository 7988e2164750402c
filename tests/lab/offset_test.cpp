// Readings with an unknown constant in each channel, from a scene's text to its answer.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/lab/identify.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

constexpr bool with_offset = true;

/// A scene of scenes/, with or without `offset = true`.
Scene shipped_scene(const std::string& name, bool offset) {
  Scene scene = read_scene(SCENES "/" + name);
  scene.reconstruct.offset = offset;
  return scene;
}

std::vector<double> moved(const Scene& scene, std::vector<double> readings, double share) {
  double largest = 0.0;
  for (const double reading : readings) largest = std::max(largest, std::abs(reading));
  for (std::size_t i = 0; const Site& site : sites(scene.sensor))
    readings[i++] += (site.channel == 0 ? share : -0.6 * share) * largest;
  return readings;
}

struct JudgedAnswer {
  std::vector<double> f{};
  UncertainResultant resultant{};
  DataVerdict data{};
};

JudgedAnswer judged_answer(const Scene& scene, const std::vector<double>& readings) {
  const SceneProblem problem(scene);
  const auto solver = make_solver(problem, Method::tikhonov);
  JudgedAnswer answer{.f = std::vector<double>(solver->tractions())};
  const FrameResult result = solver->solve(readings, answer.f);
  REQUIRE(result.status == FrameStatus::ok);
  const SceneFrame frame(problem, readings);
  answer.resultant = uncertainty(frame, answer.f, result).resultant;
  answer.data = data_verdict(problem, readings, answer.f).value();
  return answer;
}

}  // namespace

TEST_CASE("a recording with a planted offset is solved as without it", "[lab][offset]") {
  const std::string name = GENERATE("recorded/thin-pad.toml", "recorded/thin-pad-contact.toml");
  const Scene scene = shipped_scene(name, with_offset);
  const Scene known = shipped_scene(name, false);
  const auto number = GENERATE(std::size_t{2}, std::size_t{5});
  CAPTURE(name, number);
  const std::vector<double> readings =
      frames::readings_of_frame(SCENES "/recorded/thin-pad.csv", scene, number);
  const std::vector<double> drifted = moved(scene, readings, 0.2);

  const JudgedAnswer plain = judged_answer(scene, readings);
  const JudgedAnswer same = judged_answer(scene, drifted);
  CHECK(relative_l2_error(same.f, plain.f) < 1e-6);
  CHECK_THAT(same.resultant.normal.value, WithinRel(plain.resultant.normal.value, 1e-6));
  CHECK_THAT(same.resultant.normal.deviation, WithinRel(plain.resultant.normal.deviation, 1e-4));
  CHECK(same.data.doubts == plain.data.doubts);
  CHECK_FALSE(same.data.has(DataDoubt::offset));

  // Where there is none the answer is that of known offsets, within what both say of themselves.
  const JudgedAnswer before = judged_answer(known, readings);
  CHECK(std::abs(plain.resultant.normal.value - before.resultant.normal.value) <=
        3.0 * std::hypot(plain.resultant.normal.deviation, before.resultant.normal.deviation));
  CHECK(plain.resultant.normal.deviation > before.resultant.normal.deviation);
  // With one, known offsets go astray by more than ten times their deviation.
  const JudgedAnswer astray = judged_answer(known, drifted);
  CHECK(std::abs(astray.resultant.normal.value - before.resultant.normal.value) >
        10.0 * before.resultant.normal.deviation);
}

TEST_CASE("missing readings leave offsets to the taxels that are there", "[lab][offset]") {
  const Scene scene = shipped_scene("recorded/thin-pad.toml", with_offset);
  std::vector<double> readings =
      moved(scene, frames::readings_of_frame(SCENES "/recorded/thin-pad.csv", scene, 5), 0.2);
  readings[7] = std::numeric_limits<double>::quiet_NaN();
  RecordingSolver frames(SceneProblem(scene), Method::tikhonov, {.missing = Missing::estimate});
  const auto found = frames.solve(readings);
  REQUIRE(found);

  Scene without = scene;
  without.dead_taxels = {7};
  std::vector<double> there = readings;
  there[7] = 0.0;  // which is dead
  CHECK(relative_l2_error(found->tractions, solve(SceneProblem(without), there).tractions) < 1e-8);

  for (std::size_t i = 1; i < readings.size(); ++i)
    readings[i] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(frames.solve(readings));  // one taxel: its offset is all that it reads
}

TEST_CASE("circuits find the tractions whatever the offsets", "[lab][offset][relaxation]") {
  Scene scene = shipped_scene("coarse/strip.toml", with_offset);
  scene.reconstruct.alpha = 1e-3;
  const Realization realization = GENERATE(Realization::ideal, Realization::least_squares);
  scene.network.realization = realization;
  const std::vector<double> readings =
      moved(scene, std::vector<double>(reading_count(scene.sensor), 0.0), 0.0);
  std::vector<double> pressed = readings;
  for (std::size_t i = 0; const Site& site : sites(scene.sensor))
    pressed[i++] = std::exp(-std::pow(site.y / 3e-3, 2)) + (site.channel == 0 ? 5.0 : -2.0);
  const SceneProblem problem(scene);
  const SceneCircuit circuit{SceneFrame(problem, pressed)};
  std::vector<double> f = operating_voltages(circuit.network().flat());
  for (double& value : f) value /= circuit.options().parts.scale.volts;
  CHECK(relative_l2_error(f, judged_answer(scene, pressed).f) < 1e-3);
}

TEST_CASE("what offsets hide is told before any reading", "[lab][offset]") {
  const auto reasons = [](bool offset) {
    return identify(shipped_scene("dragged.toml", offset), {.relative_noise = 0.01}).reasons;
  };
  const auto is_offset = [](const HiddenReason& reason) {
    return std::holds_alternative<hidden_reason::UnknownOffsets>(reason);
  };
  const auto with = reasons(true);
  const auto without = reasons(false);
  CHECK(std::count_if(with.begin(), with.end(), is_offset) == 1);
  CHECK(std::none_of(without.begin(), without.end(), is_offset));
  const Survey survey = identify(shipped_scene("dragged.toml", true), {.relative_noise = 0.01});
  CHECK(hides_mean(survey.own, Traction::normal));
}

TEST_CASE("methods that need known offsets refuse them", "[lab][offset]") {
  const Scene scene = shipped_scene("dragged.toml", with_offset);
  CHECK_THROWS_WITH(make_solver(scene, Method::dft),
                    ContainsSubstring("dft cannot tell an unknown offset"));

  // An array that is solved by FFT otherwise is solved by a decomposition.
  Scene long_array = scene;
  long_array.sensor.count = 1100;
  CHECK(SceneProblem(shipped_scene("dragged.toml", false)).is_large() == false);
  CHECK_FALSE(SceneProblem(long_array).is_large());
  long_array.reconstruct.offset = false;
  CHECK(SceneProblem(long_array).is_large());
}

TEST_CASE("a circuit's nodes may lie further apart than the surface's values",
          "[lab][relaxation][spacing]") {
  Scene scene = read_scene(SCENES "/coarse/finger.toml");
  scene.reconstruct.alpha = 1e-4;
  std::vector<double> readings;
  for (const Site& site : sites(scene.sensor))
    readings.push_back(1e4 * std::exp(-std::pow((site.y - 1e-3) / 3e-3, 2)));
  const SceneProblem problem(scene);
  const double own = problem.surface().spacing;

  scene.network.spacing = 4.0 * own;
  const SceneProblem coarse_nodes(scene);
  const SceneCircuit circuit{SceneFrame(coarse_nodes, readings)};
  const Surface nodes = surface(std::get<Scene>(circuit.scene()));
  CHECK_THAT(nodes.spacing, WithinRel(4.0 * own, 1e-12));
  CHECK(circuit.nodes() == nodes.count);
  CHECK(circuit.nodes() < problem.surface().count / 3);

  // The minimiser on that grid, asked for directly.
  Scene coarse = scene;
  coarse.network.spacing.reset();
  coarse.reconstruct.surface.spacing = 4.0 * own;
  const SceneProblem direct(coarse);
  std::vector<double> expected(direct.tractions());
  REQUIRE(make_solver(direct, Method::tikhonov)->solve(readings, expected).status ==
          FrameStatus::ok);
  CHECK(relative_l2_error(circuit.direct(), expected) < 1e-9);
  std::vector<double> f = operating_voltages(circuit.network().flat());
  for (double& value : f) value /= circuit.options().parts.scale.volts;
  CHECK(relative_l2_error(f, expected) < 1e-3);
  // Neither alpha nor the force follows the spacing.
  std::vector<double> fine(problem.tractions());
  REQUIRE(make_solver(problem, Method::tikhonov)->solve(readings, fine).status == FrameStatus::ok);
  const auto force = [](const std::vector<double>& values, double spacing) {
    return spacing * std::accumulate(values.begin(), values.end(), 0.0);
  };
  CHECK_THAT(force(expected, 4.0 * own), WithinRel(force(fine, own), 0.05));
  CHECK(workload(scene).tasks.size() == workload(coarse).tasks.size());

  scene.reconstruct.surface = {};
  CHECK_THROWS_WITH(SceneCircuit(SceneFrame(SceneProblem(scene), readings)),
                    ContainsSubstring("network.spacing applies to a grid"));
}

}  // namespace tactile_net::lab
