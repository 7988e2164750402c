#include "tactile_net/lab/data_verdict.hpp"

#include "lab/skin_data_verdict.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/repeating_taxels.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

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

TEST_CASE("limits are the scene's, whatever the quantity", "[data]") {
  Scene scene;
  scene.sensor = {.count = 15, .pitch = 1.0, .depths = {1.5}};
  scene.material.youngs_modulus = 7.0;
  scene.sensor.reads = {Quantity::stress_x, Quantity::strain_x};
  scene.noise = NoiseModel{.rms = {{Quantity::stress_x, 1e-3}, {Quantity::strain_x, 1e-4}},
                           .weights_rows = true};
  scene.reconstruct.friction_limit = 0.8;
  const DataLimits limits = lab::data_limits(lab::SceneProblem(scene));
  CHECK(limits.friction_limit == 0.8);
  SkinScene skin;
  skin.sensor.depths = {1.0};
  skin.sensor.rows = skin.sensor.columns = 2;
  skin.sensor.pitch_y = skin.sensor.pitch_z = 1.0;
  skin.sensor.reads = {Quantity::stress_x, Quantity::shear_xy};
  skin.reconstruct.friction_limit = 0.7;
  CHECK(lab::data_limits(lab::SkinSceneProblem(skin)).friction_limit == 0.7);
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
