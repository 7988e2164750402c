#include "tactile_net/lab/data_verdict.hpp"

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/repeating_taxels.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

Scene pressed_line() {
  Scene scene;
  scene.sensor = {.count = 15, .pitch = 1.0, .depths = {1.5}, .reads = {Quantity::stress_x}};
  scene.contacts = {RigidContact{.center = 0.4, .half_width = 2.0, .force = 0.4}};
  scene.forward = ForwardModel::exact;
  scene.noise = NoiseModel{.rms = {{Quantity::stress_x, 1e-3}}};
  scene.reconstruct.alpha = 1e-5;
  scene.reconstruct.smoothing_length = 1.5;
  scene.reconstruct.surface = {.basis = SurfaceBasis::hats};
  return scene;
}

lab::FrameAnswer solved_with_verdict(const lab::SceneProblem& problem,
                                     const std::vector<double>& readings) {
  const auto solver = lab::make_solver(problem, Method::tikhonov);
  std::vector<double> f(solver->tractions());
  const lab::FrameResult result = solver->solve(readings, f);
  return {.tractions = f,
          .alpha = *result.alpha,
          .verdict = result.verdict,
          .solved = result.verdict,
          .condition = result.condition,
          .data = lab::data_verdict(problem, readings, f),
          .constrained = result.constrained};
}

}  // namespace

TEST_CASE("a scene's own frame is consistent, and not with one taxel dead", "[data]") {
  const lab::SceneProblem problem(pressed_line());
  std::vector<double> readings = lab::simulate(problem.scene()).readings;
  CHECK(solved_with_verdict(problem, readings).data->consistent());
  readings[7] = 0.0;
  const lab::FrameAnswer doubted = solved_with_verdict(problem, readings);
  REQUIRE(doubted.data);
  CHECK(doubted.data->taxel == 7);

  lab::SolvedFrames frames;
  frames.add(doubted);
  CHECK(frames.doubted.at(DataDoubt::bad_taxel).count() == 1);
  CHECK(frames.bad_taxels.at(7) == 1);
  CHECK(frames.noise_known);

  lab::Recording recording(problem, Method::tikhonov);
  recording.add(0.0, problem, readings, doubted);
  const lab::RecordingOverview overview = recording.overview();
  CHECK(overview.doubted == 1);
  CHECK(overview.doubts.at(DataDoubt::bad_taxel) == 1);
  CHECK(overview.groups.front().doubted == 1);
  CHECK(overview.groups.front().answer.data->taxel == 7);
}

TEST_CASE("no answer is ok whose readings cannot be true, or whose force is not told",
          "[data][verdict]") {
  const DataVerdict fine{.noise_known = true};
  const DataVerdict empty{.noise_known = true, .noise_alone = true};
  DataVerdict wrong = fine;
  wrong.doubts.push_back(DataDoubt::misfit);
  using lab::overall;
  using lab::Verdict;
  CHECK(overall(Verdict::ok, wrong) == Verdict::doubted);
  CHECK(overall(Verdict::ok, fine) == Verdict::ok);
  CHECK(overall(Verdict::ok, fine, Uncertain{2.0, 19.9}) == Verdict::undetermined);
  CHECK(overall(Verdict::ok, fine, Uncertain{2.0, 0.2}) == Verdict::ok);
  for (const Verdict other : {Verdict::clipped, Verdict::border, Verdict::undetermined})
    CHECK(overall(other, wrong, Uncertain{2.0, 19.9}) == other);
  // Where nothing presses there is no fault in that.
  CHECK(is_faultless(overall(Verdict::ok, empty, Uncertain{0.1, 0.2})));
  for (const Verdict of_alpha : {Verdict::border, Verdict::no_root, Verdict::oversmoothed}) {
    CHECK(overall(of_alpha, empty, Uncertain{0.1, 0.2}) == Verdict::no_contact);
    CHECK(overall(of_alpha, empty, Uncertain{2.0, 0.2}) == of_alpha);
    CHECK(overall(of_alpha, fine, Uncertain{0.1, 0.2}) == of_alpha);
  }
  CHECK(overall(Verdict::ok, std::nullopt) == Verdict::ok);
}

TEST_CASE("every command's verdict knows the data's", "[data][verdict]") {
  Scene scene = pressed_line();
  const bool lies = GENERATE(false, true);
  lab::RecordingSolver line{lab::SceneProblem(scene), Method::tikhonov};
  std::vector<double> readings = lab::simulate(scene).readings;
  if (lies) readings[7] = 0.0;
  const auto found = line.solve(readings);
  REQUIRE(found);
  CHECK(found->data->consistent() != lies);
  CHECK(found->verdict == (lies ? lab::Verdict::doubted : lab::Verdict::ok));
  CHECK(line.solved().distrusted.size() == (lies ? 1U : 0U));

  // A frame of noise has no fault, whatever alpha's rule makes of it.
  scene.reconstruct.alpha.reset();
  scene.contacts.clear();
  lab::RecordingSolver idle{lab::SceneProblem(scene), Method::tikhonov};
  std::vector<double> noise = lab::simulate(scene).readings;
  const auto nothing = idle.solve(noise);
  REQUIRE(nothing);
  CHECK(is_faultless(nothing->verdict));
  CHECK(idle.solved().distrusted.empty());
}

TEST_CASE("under constraints readings that only a pull explains pull", "[data][verdict]") {
  Scene scene = pressed_line();
  std::vector<double> readings = lab::simulate(scene).readings;
  for (double& reading : readings) reading = -reading;
  scene.reconstruct.nonnegative = true;
  const lab::FrameAnswer result = solved_with_verdict(lab::SceneProblem(scene), readings);
  CHECK(result.data->doubts == std::vector{DataDoubt::pulls});
}

TEST_CASE("a taxel that is listed as dead is not asked", "[data]") {
  Scene scene = pressed_line();
  std::vector<double> readings = lab::simulate(scene).readings;
  scene.dead_taxels = {7};
  readings[7] = 0.0;
  CHECK(solved_with_verdict(lab::SceneProblem(scene), readings).data->consistent());
}

TEST_CASE("limits are the scene's, whatever the quantity", "[data]") {
  Scene scene = pressed_line();
  scene.material.youngs_modulus = 7.0;
  scene.sensor.reads = {Quantity::stress_x, Quantity::strain_x};
  scene.noise = NoiseModel{.rms = {{Quantity::stress_x, 1e-3}, {Quantity::strain_x, 1e-4}},
                           .weights_rows = true};
  const DataLimits limits = lab::data_limits(lab::SceneProblem(scene));
  CHECK(limits.noise_rms == 1.0);
  CHECK(limits.largest_traction == 7.0);
  REQUIRE(limits.largest_readings.size() == 30);
  CHECK(limits.largest_readings.front() == 7.0);
  CHECK(limits.largest_readings.back() == 1.0);
  REQUIRE(limits.inner);
  CHECK_THAT(limits.inner->first, WithinRel(-3.5, 1e-12));
  CHECK_THAT(limits.inner->second, WithinRel(3.5, 1e-12));
}

namespace {

SensorArray eight_reading(std::vector<Quantity> reads) {
  return {.count = 8, .pitch = 1.0, .depths = {1.0}, .reads = std::move(reads)};
}

}  // namespace

TEST_CASE("a taxel that repeats while the others move is found, all of its channels", "[data]") {
  const std::vector<std::size_t> dead = {0};
  lab::RepeatingTaxels watch(eight_reading({Quantity::stress_x, Quantity::shear_xy}), dead);
  std::vector<double> readings(16);
  const auto next = [&](double k) {
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (i % 8 != 3 && i % 8 != 0) readings[i] = k + static_cast<double>(i);
    watch.add(readings);
  };
  for (std::size_t k = 0; k < lab::RepeatingTaxels::least_repeats; ++k) {
    next(static_cast<double>(k));
    CHECK_FALSE(watch.first());
  }
  next(100.0);
  CHECK(watch.first() == 3);
  readings[11] += 1.0;  // its second channel
  next(101.0);
  CHECK_FALSE(watch.first());
}

TEST_CASE("frames that repeat as a whole show no single taxel", "[data]") {
  lab::RepeatingTaxels watch(eight_reading({Quantity::stress_x}), {});
  const std::vector<double> readings(8, 1.0);
  for (int k = 0; k < 20; ++k) watch.add(readings);
  CHECK_FALSE(watch.first());
}
