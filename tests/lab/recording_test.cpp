#include "tactile_net/lab/recording.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/lab/interior.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

SceneProblem pad_problem() {
  return SceneProblem(
      parse_scene("[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.0\nreads = [\"stress_x\"]\n"
                  "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                  "[noise]\nrms = 1e-3\n[reconstruct]\nalpha = 1e-3\n",
                  "pad.toml"));
}

/// A recording whose frames all press with 1, but one. No band judges them: nothing has read them.
Recording tapped_recording(std::size_t frames, std::size_t tap) {
  const SceneProblem problem = pad_problem();
  Recording recording(problem, Method::dft);
  std::vector<double> tractions(21);
  for (std::size_t i = 0; i < frames; ++i) {
    std::fill(tractions.begin(), tractions.end(), i == tap ? 7.0 : 1.0);
    recording.add(0.001 * static_cast<double>(i), problem, tractions,
                  {.tractions = tractions,
                   .alpha = {.value = 1e-3},
                   .verdict = i == tap + 1 ? Verdict::unstable : Verdict::ok});
  }
  return recording;
}

}  // namespace

TEST_CASE("every frame of a recording is counted once, in a bounded number of groups",
          "[lab][recording]") {
  for (const std::size_t frames : {1U, 2U, 1499U, 1500U, 1501U, 20'000U}) {
    CAPTURE(frames);
    const RecordingOverview overview = tapped_recording(frames, frames / 3).overview();
    CHECK(overview.frames == frames);
    CHECK(overview.groups.size() <= Recording::most_groups);
    CHECK(overview.groups.size() >= std::min<std::size_t>(frames, Recording::most_groups / 2));
    std::size_t next = 0;
    for (const FrameGroup& group : overview.groups) {
      CHECK(group.first == next);
      CHECK(group.shown >= group.first);
      CHECK(group.shown < group.first + group.count);
      CHECK_THAT(group.time, WithinRel(0.001 * static_cast<double>(group.shown), 1e-12));
      next += group.count;
    }
    CHECK(next == frames);
  }
}

TEST_CASE("a tap of one frame and a verdict of one frame survive the thinning",
          "[lab][recording]") {
  const std::size_t tap = 12'345;
  const RecordingOverview overview = tapped_recording(100'000, tap).overview();
  CHECK(overview.peak().shown == tap);
  CHECK_THAT(overview.peak().highest_normal, WithinRel(7.0 * 21 * 0.5, 1e-12));
  CHECK_THAT(overview.peak().lowest_normal, WithinRel(21 * 0.5, 1e-12));
  std::size_t distrusted = 0;
  for (const FrameGroup& group : overview.groups) {
    distrusted += group.distrusted;
  }
  CHECK(distrusted == 1);
  CHECK(overview.verdicts.at(Verdict::unstable) == 1);
  CHECK(overview.verdicts.at(Verdict::ok) == 99'999);
}

TEST_CASE("frames without an answer count where they are", "[lab][recording]") {
  const SceneProblem problem = pad_problem();
  const std::vector<double> ones(21, 1.0);
  Recording recording(problem, Method::dft);
  for (std::size_t i = 0; i < 5000; ++i) {
    if (i % 7 == 0)
      recording.skip();
    else
      recording.add(0.001 * static_cast<double>(i), problem, ones,
                    {.tractions = ones, .alpha = {.value = 1e-3}});
  }
  const RecordingOverview overview = recording.overview();
  CHECK(overview.frames == 5000);
  CHECK(overview.skipped.count() == 715);
  CHECK(overview.verdicts.at(Verdict::failed) == 715);
  std::size_t next = 0;
  std::size_t distrusted = 0;
  for (const FrameGroup& group : overview.groups) {
    CHECK(group.first == next);
    CHECK(group.shown % 7 != 0);
    CHECK_THAT(group.time, WithinRel(0.001 * static_cast<double>(group.shown), 1e-12));
    next += group.count;
    distrusted += group.distrusted;
  }
  CHECK(next == 5000);
  CHECK(distrusted == 715);
}

TEST_CASE("the bands of a recording's frame are those that uncertainty gives", "[lab][recording]") {
  const SceneProblem problem = pad_problem();
  const auto solver = make_solver(problem, Method::tikhonov);
  Recording recording(problem, Method::tikhonov);
  std::vector<double> readings(21);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = std::exp(-0.3 * std::pow(static_cast<double>(i) - 9.0, 2));
  std::vector<double> tractions(21);
  const FrameResult result = solver->solve(readings, tractions);
  recording.add({}, problem, readings, {.tractions = tractions, .alpha = *result.alpha});
  const FrameGroup group = recording.overview().groups.at(0);
  const FrameUncertainty expected = uncertainty(SceneFrame(problem, readings), tractions, result);
  REQUIRE(group.answer.bands);
  CHECK(group.answer.bands->deviation == expected.deviation);
  CHECK(group.answer.bands->resultant.normal.value == group.resultant.normal);
  CHECK(std::isnan(group.time));
}

TEST_CASE("inside the pad a uniform pressure is a uniform stress", "[lab][interior]") {
  Scene scene = pad_problem().scene();
  scene.sensor.count = 401;
  const InteriorKernels kernels = interior_kernels(scene, 6, true);
  REQUIRE(kernels.depths.size() == 6);
  REQUIRE(kernels.lags == 801);
  for (std::size_t row = 0; row < 6; ++row) {
    const auto begin = kernels.of_normal.begin() + static_cast<std::ptrdiff_t>(row * kernels.lags);
    // What lies beyond the ends of 801 strips: the tail of 2 x^3 / (pi r^4).
    CHECK_THAT(std::accumulate(begin, begin + 801, 0.0), WithinRel(1.0, 1e-3));
    const auto drag =
        kernels.of_tangential.begin() + static_cast<std::ptrdiff_t>(row * kernels.lags);
    CHECK_THAT(std::accumulate(drag, drag + 801, 0.0), WithinAbs(0.0, 1e-12));
    CHECK_THAT(drag[401], WithinRel(-drag[399], 1e-9));
  }
}

TEST_CASE("the stress inside is linear in the load, and a loaded taxel's is its kernel",
          "[lab][interior]") {
  const Scene scene = pad_problem().scene();
  const std::size_t n = scene.sensor.count;
  const InteriorKernels kernels = interior_kernels(scene, 4, true);
  std::vector<double> press(n);
  std::vector<double> drag(n);
  press[3] = 1.0;
  drag[15] = -2.0;
  const std::vector<double> pressed = interior_stress(kernels, press, {});
  const std::vector<double> both = interior_stress(kernels, press, drag);
  REQUIRE(both.size() == 4 * n);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t lag = row * kernels.lags + i + n - 1;
      CHECK(pressed[row * n + i] == kernels.of_normal[lag - 3]);
      CHECK_THAT(both[row * n + i] - pressed[row * n + i],
                 WithinAbs(-2.0 * kernels.of_tangential[lag - 15], 1e-15));
    }
}

TEST_CASE("a picture of the pad reaches the base, or twice the deepest taxel", "[lab][interior]") {
  Scene scene = pad_problem().scene();
  scene.sensor.depths = {1.0, 0.5};
  CHECK(interior_depth(scene) == 2.0);
  scene.material.layer = Layer{.thickness = 3.0};
  CHECK(interior_depth(scene) == 3.0);
}

}  // namespace tactile_net::lab
