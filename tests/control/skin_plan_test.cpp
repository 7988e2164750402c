// What plans of skins find in frames of contacts: forces, margins and liars among the cells that
// touch. Laws that lines share: plan_laws_test.cpp.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/load.hpp"
#include "tests/catch.hpp"
#include "tests/control/plan_cases.hpp"

using namespace tactile_net;

TEST_CASE("a press, a drag and a twist are found in a frame", "[skin_plan]") {
  const double noise = 5.0;  // Pa, of some 10 kPa
  const Skin skin = square(12);
  const PlannedEstimator one =
      planned(skin, 1e-4, {.noise_rms = noise, .friction_coefficient = 0.8});
  ContactEstimator estimator(one.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const SkinContact contact{
      .y = 1e-3, .z = -2e-3, .radius = 4e-3, .force = 1.5, .friction = 0.3, .direction = 0.6};
  const std::vector<SkinLoad> loads{contact};
  std::vector<double> readings = exact_readings(skin.array, skin.material, loads);
  std::mt19937 generator(3);
  std::normal_distribution<double> of_noise(0.0, noise);
  for (double& reading : readings) reading += of_noise(generator);
  REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
  CHECK(e.contact);
  CHECK(e.touching > 10);
  CHECK(e.touching < one.plan.values / 2);
  CHECK_THAT(e.normal_force, WithinRel(1.5, 0.05));
  CHECK_THAT(e.tangential_y, WithinAbs(0.45 * std::cos(0.6), 0.03));
  CHECK_THAT(e.tangential_z, WithinAbs(0.45 * std::sin(0.6), 0.03));
  CHECK_THAT(e.centre, WithinAbs(1e-3, 1e-4));
  CHECK_THAT(e.centre_z, WithinAbs(-2e-3, 1e-4));
  CHECK_THAT(e.torsion, WithinAbs(0.0, 1e-4));
  CHECK_THAT(e.friction_margin, WithinRel(0.8 * 1.5 - 0.45, 0.1));
  CHECK_THAT(e.slip_margin, WithinAbs(1.0 - 0.3 / 0.8, 0.05));
  CHECK_FALSE(e.misfit);
  CHECK_FALSE(e.pulls);
  CHECK(e.outlier == -1);

  // Nothing touches: noise alone.
  for (double& reading : readings) reading = of_noise(generator);
  REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
  CHECK_FALSE(e.contact);
  CHECK(std::isnan(e.centre));
}

TEST_CASE("two contacts that are dragged apart have the margin of one of them", "[skin_plan]") {
  const double noise = 5.0;
  const double mu = 0.5;
  const Skin skin = fine(10);
  const PlannedEstimator one =
      planned(skin, 1e-4, {.noise_rms = noise, .friction_coefficient = mu});
  ContactEstimator estimator(one.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const auto update = [&](const std::vector<SkinLoad>& loads) {
    REQUIRE(estimator.update(exact_readings(skin.array, skin.material, loads), e) ==
            FrameStatus::ok);
  };
  const double used = GENERATE(0.3, 0.9);
  SkinContact left{.y = -5e-3, .radius = 2.5e-3, .force = 0.5, .friction = used * mu};
  SkinContact right = left;
  right.y = -left.y;
  right.direction = std::numbers::pi;
  update({left});
  CHECK(e.contacts == 1);
  const double alone = e.slip_margin;
  const double in_newtons = e.friction_margin;
  CHECK_THAT(alone, WithinAbs(1.0 - used, 0.15));  // the pad blurs drag and pressure
  update({left, right});
  CHECK(e.contacts == 2);
  CHECK_THAT(e.normal_force, WithinRel(1.0, 0.1));  // of both
  CHECK_THAT(e.tangential_force, WithinAbs(0.0, 0.01));
  CHECK_THAT(e.slip_margin, WithinAbs(alone, 0.05));  // of one
  CHECK_THAT(e.friction_margin, WithinAbs(in_newtons, 0.05 * mu * left.force));
  // The weaker one slips first.
  left.force = 0.2;
  right.friction = 0.1 * mu;
  update({left, right});
  CHECK(e.contacts == 2);
  CHECK_THAT(e.margin_centre, WithinAbs(left.y, 5e-4));
  CHECK_THAT(e.margin_centre_z, WithinAbs(0.0, 5e-4));
  CHECK_THAT(e.slip_margin, WithinAbs(alone, 0.1));
}

TEST_CASE("the deviation of a found contact's force holds what noise does to it", "[skin_plan]") {
  const double noise = GENERATE(5.0, 50.0);
  const Skin skin = GENERATE(fine(8), square(9));
  const PlannedEstimator one = planned(skin, 1e-3, {.noise_rms = noise});
  ContactEstimator estimator(one.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const std::vector<SkinLoad> loads{SkinContact{.y = 1e-3, .radius = 3e-3, .force = 1.0}};
  const std::vector<double> exact = exact_readings(skin.array, skin.material, loads);
  std::mt19937 generator(5);
  std::normal_distribution<double> of_noise(0.0, noise);
  double sum = 0.0;
  double squares = 0.0;
  double said = 0.0;
  constexpr int frames = 60;
  for (int k = 0; k < frames; ++k) {
    std::vector<double> readings = exact;
    for (double& reading : readings) reading += of_noise(generator);
    REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
    REQUIRE(e.touching > 0);
    sum += e.normal_force / frames;
    squares += e.normal_force * e.normal_force / frames;
    said += e.force_deviation / frames;
  }
  const double spread = std::sqrt(squares - sum * sum);
  CAPTURE(skin.name, noise, spread, said);
  CHECK(said > 0.8 * spread);
  CHECK(said < 6.0 * spread);
}

TEST_CASE("a taxel that lies is found, and no contact near the edge is taken for one",
          "[skin_plan]") {
  const double noise = 5.0;
  const Skin skin = square(10);
  const PlannedEstimator one = planned(skin, 1e-4, {.noise_rms = noise});
  ContactEstimator estimator(one.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  std::mt19937 generator(8);
  std::normal_distribution<double> of_noise(0.0, noise);
  int alarms = 0;
  int found = 0;
  for (int k = 0; k < 40; ++k) {
    const double y = -10e-3 + 0.5e-3 * k;
    const std::vector<SkinLoad> loads{
        SkinContact{.y = y, .z = 7e-3, .radius = 3e-3, .force = 1.0, .friction = 0.2}};
    std::vector<double> readings = exact_readings(skin.array, skin.material, loads);
    for (double& reading : readings) reading += of_noise(generator);
    REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
    alarms += e.outlier >= 0 ? 1 : 0;
    const std::size_t liar = 44 + 100 * static_cast<std::size_t>(k % 3);
    readings[liar] += 3000.0;
    REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
    found += e.outlier == static_cast<std::ptrdiff_t>(liar) ? 1 : 0;
  }
  CHECK(alarms == 0);
  CHECK(found == 40);
}
