#include <algorithm>
#include <cmath>

#include "tactile_net/calibration/press_fit.hpp"
#include "tests/calibration/simulated_log.hpp"
#include "tests/calibration/unknown_sd.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

/// The press' reading without its offset, times a factor.
void scale(SimulatedLog& made, Press& press, std::size_t reading, double factor) {
  double& value = press.readings[reading];
  value = made.offsets[reading] + factor * (value - made.offsets[reading]);
}

SimulatedLog with_stated_sds(unsigned seed) {
  SimulatedLog made = simulated_log(seed, {.knows_width = false});
  for (Press& press : made.log.presses) {
    press.force.sd = 0.02 * *press.force.value;
    press.position.sd = 1e-4;
  }
  return made;
}

}  // namespace

TEST_CASE("readings of the other sign are refused before anything is fitted") {
  const bool knows = GENERATE(true, false);
  SimulatedLog made =
      simulated_log(31, {.knows_width = knows, .knows_centre = knows, .knows_force = knows});
  for (Press& press : made.log.presses)
    for (std::size_t j = 0; j < press.readings.size(); ++j) scale(made, press, j, -1.0);
  CHECK_THROWS_WITH(fit_presses(made.model(), made.log),
                    ContainsSubstring("other sign") && ContainsSubstring("20 of 20"));
}

TEST_CASE("one channel of the other sign is named") {
  SimulatedLog made = simulated_log(32, {.reads = {Quantity::stress_x, Quantity::shear_xy}});
  for (Press& press : made.log.presses)
    for (std::size_t j = 41; j < 82; ++j) scale(made, press, j, -1.0);
  CHECK_THROWS_WITH(fit_presses(made.model(), made.log), StartsWith("shear_xy has the other sign"));
}

TEST_CASE("forces that are wrong by a thousand are refused with their scale") {
  SimulatedLog made = simulated_log(5);
  const double factor = GENERATE(1e3, 1e-3);
  for (Press& press : made.log.presses) press.force.value = factor * *press.force.value;
  CHECK_THROWS_WITH(fit_presses(made.model(), made.log), ContainsSubstring("units of the forces"));
  CalibrationOptions counts;  // numbers of a converter: their scale is not known
  counts.mean_gain_sd = unknown_sd;
  CHECK(fit_presses(made.model(), made.log, counts).verdict == FitVerdict::ok);
}

TEST_CASE("positions that run against the array or are in other units are refused") {
  SimulatedLog made = simulated_log(33, {.knows_width = false});
  SimulatedLog other = made;
  for (Press& press : made.log.presses) press.position.value = -*press.position.value;
  CHECK_THROWS_WITH(fit_presses(made.model(), made.log),
                    ContainsSubstring("run against the array"));
  for (Press& press : other.log.presses) press.position.value = 1e-3 * *press.position.value;
  CHECK_THROWS_WITH(fit_presses(other.model(), other.log), ContainsSubstring("another unit"));
}

TEST_CASE("a hopeless fit ends within its steps, and a depth that ran away is named") {
  SimulatedLog made = simulated_log(34, {.knows_width = false, .knows_centre = false});
  std::mt19937_64 random(1);
  for (Press& press : made.log.presses)  // every press has the readings of a reading elsewhere
    std::shuffle(press.readings.begin(), press.readings.end(), random);
  CalibrationOptions options;
  options.depth_sd = options.thickness_sd = unknown_sd;
  std::size_t steps = 0;
  const PressFit fit =
      fit_presses(made.model(), made.log, options, {}, [&](std::size_t) { ++steps; });
  CHECK(fit.verdict != FitVerdict::ok);
  CHECK(steps > 0);
  CHECK(steps <= 25 * options.starts.size());
  const double factor = fit.at(PadParameter::depth).value / made.nominal_depth;
  CHECK(factor >= 0.25 * (1.0 - 1e-9));
  CHECK(factor <= 10.0 * (1.0 + 1e-9));
  for (const FittedPress& press : fit.presses) CHECK(press.half_width.value < 0.05);
}

TEST_CASE("a depth of ten times the stated one is at its bound and contradicts the scene") {
  SimulatedLog made = simulated_log(35);
  made.nominal_depth = 1e-4;  // the truth is 15 times as deep
  CalibrationOptions options;
  options.depth_sd = unknown_sd;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  CHECK(fit.at(PadParameter::depth).verdict == ValueVerdict::at_bound);
  CHECK(std::count(fit.contradicted.begin(), fit.contradicted.end(), PadParameter::depth) == 1);
  CHECK(fit.verdict == FitVerdict::poor_fit);
}

TEST_CASE("a taxel that is dead, weak or loud and not listed is named") {
  const bool robust = GENERATE(false, true);
  const double factor = GENERATE(0.0, 0.3, 3.0);
  SimulatedLog made = simulated_log(36);
  for (Press& press : made.log.presses) scale(made, press, 17, factor);
  CalibrationOptions options;
  options.robust = robust;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  CAPTURE(robust, factor, fit.gains[17]);
  CHECK(fit.doubtful_readings == std::vector<std::size_t>{17});
  CHECK(fit.verdict == FitVerdict::poor_fit);
}

TEST_CASE("sound logs are not doubted", "[long]") {
  std::size_t trends = 0;
  for (unsigned seed = 4000; seed < 4200; ++seed) {
    const PressFit fit =
        fit_presses(with_stated_sds(seed).model(), with_stated_sds(seed).log, {.starts = {1.0}});
    CAPTURE(seed);
    CHECK(fit.doubtful_readings.empty());
    CHECK(fit.contradicted_presses.empty());
    CHECK(fit.contradicted.empty());
    trends += fit.time_trend.is_significant() ? 1U : 0U;
  }
  CHECK(trends <= 2);  // 0.2 are expected
}

namespace {
void check_wrong_press(bool robust, PressQuantity quantity, bool exact) {
  SimulatedLog made = with_stated_sds(37);
  if (exact)
    for (Press& press : made.log.presses) press.force.sd = press.position.sd = 0.0;
  Press& wrong = made.log.presses[8];
  if (quantity == PressQuantity::force)
    wrong.force.value = 1.4 * *wrong.force.value;
  else
    wrong.position.value = *wrong.position.value + 2.5e-3;
  CalibrationOptions options;
  options.robust = robust;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  CAPTURE(robust, exact, std::string(name(quantity)), fit.rms);
  if (robust) {
    CHECK(fit.verdict == FitVerdict::ok);
    for (const FittedPress& press : fit.presses) {
      CAPTURE(press.number);
      CHECK(press.put_aside == (press.number == 9 ? std::optional(quantity) : std::nullopt));
    }
  } else {
    CHECK(fit.verdict == FitVerdict::poor_fit);
    REQUIRE_FALSE(fit.contradicted_presses.empty());
    CHECK(fit.contradicted_presses.front().press == 9);
    CHECK(fit.contradicted_presses.front().quantity == quantity);
  }
}
}  // namespace

TEST_CASE("a press whose force or position is stated wrongly is named with it") {
  // Every two of the three meet in every way.
  const auto [robust, quantity, exact] =
      GENERATE(table<bool, PressQuantity, bool>({{false, PressQuantity::force, false},
                                                 {false, PressQuantity::position, true},
                                                 {true, PressQuantity::force, true},
                                                 {true, PressQuantity::position, false}}));
  check_wrong_press(robust, quantity, exact);
}

TEST_CASE("a press that is stated wrongly is named in the other ways of options, too", "[long]") {
  check_wrong_press(false, PressQuantity::force, true);
  check_wrong_press(false, PressQuantity::position, false);
  check_wrong_press(true, PressQuantity::force, false);
  check_wrong_press(true, PressQuantity::position, true);
}

TEST_CASE("a friction that is put aside no longer pulls") {
  const double drag = 0.3;
  SimulatedLog made =
      simulated_log(41, {.reads = {Quantity::stress_x, Quantity::shear_xy}, .drag = drag});
  for (Press& press : made.log.presses) press.friction = {.value = 0.0, .sd = 0.01};
  const CalibrationOptions options{.robust = true};
  const PressFit fit = fit_presses(made.model(), made.log, options);
  for (const FittedPress& press : fit.presses) {
    CAPTURE(press.number);
    CHECK(press.put_aside ==
          (press.number == 9 ? std::optional(PressQuantity::friction) : std::nullopt));
  }
  // As if nothing had been stated of it.
  made.log.presses[8].friction = {};
  const PressFit unknown = fit_presses(made.model(), made.log, options);
  const ValueWithSd& found = fit.presses[8].friction;
  CAPTURE(found.value, found.sd, unknown.presses[8].friction.value);
  CHECK_THAT(found.value, WithinAbs(unknown.presses[8].friction.value, 0.5 * found.sd));
  CHECK_THAT(found.sd, WithinRel(unknown.presses[8].friction.sd, 0.1));
  CHECK_THAT(found.value, WithinAbs(drag, 4.0 * found.sd));
}

TEST_CASE(
    "readings that grow from press to press are seen in a short log, and quiet ones are not") {
  SimulatedLog made = simulated_log(38, {.presses = 12});
  const PressFit quiet = fit_presses(made.model(), made.log);
  CHECK_FALSE(quiet.time_trend.is_significant());
  for (std::size_t p = 0; p < made.log.presses.size(); ++p)
    for (std::size_t j = 0; j < made.gains.size(); ++j)
      scale(made, made.log.presses[p], j, 1.0 + 0.02 * static_cast<double>(p));
  const PressFit fit = fit_presses(made.model(), made.log);
  CAPTURE(fit.time_trend.correlation, fit.time_trend.p);
  CHECK(fit.time_trend.is_significant());
  CHECK(fit.time_trend.of == TrendOf::gain);
  CHECK(fit.time_trend.correlation > 0.0);
}

TEST_CASE("a gain that grows in the log is seen though stated forces give way to it") {
  SimulatedLog made = with_stated_sds(41);
  for (std::size_t p = 0; p < made.log.presses.size(); ++p)
    for (std::size_t j = 0; j < made.gains.size(); ++j)
      scale(made, made.log.presses[p], j, 1.0 + 0.01 * static_cast<double>(p));
  const PressFit fit = fit_presses(made.model(), made.log);
  CAPTURE(fit.rms, fit.time_trend.correlation, fit.time_trend.p);
  CHECK(fit.contradicted_presses.empty());  // none of them by itself
  CHECK(fit.time_trend.is_significant());
  CHECK(fit.time_trend.of == TrendOf::gain);
  CHECK(fit.time_trend.correlation > 0.0);
  REQUIRE(fit.understated.size() == 1);
  CHECK(fit.understated.front().quantity == PressQuantity::force);
  CHECK(fit.understated.front().presses > 10);
  CHECK(fit.understated.front().rms > 1.5);
}

TEST_CASE("standard deviations that hold are not called too small", "[long]") {
  std::size_t doubted = 0, trends = 0;
  for (unsigned seed = 5000; seed < 5200; ++seed) {
    SimulatedLog made = with_stated_sds(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (Press& press : made.log.presses) {
      press.force.value = *press.force.value + press.force.sd * normal(random);
      press.position.value = *press.position.value + press.position.sd * normal(random);
    }
    const PressFit fit = fit_presses(made.model(), made.log, {.starts = {1.0}});
    doubted += fit.understated.empty() ? 0U : 1U;
    trends += fit.time_trend.is_significant() ? 1U : 0U;
  }
  CHECK(doubted <= 3);  // 0.4 are expected
  CHECK(trends <= 2);   // 0.2 are
}

TEST_CASE("crosstalk that is stated is part of the pad") {
  const SimulatedLog made = simulated_log(39, {.noise = 1e-6});
  PressLog log = made.log;
  const PressModel clean(made.array, made.truth);
  for (Press& press : log.presses) {  // as sensing/effects/crosstalk has it, before the gains
    std::vector<double> read(made.gains.size());
    for (std::size_t j = 0; j < read.size(); ++j)
      read[j] = (press.readings[j] - made.offsets[j]) / made.gains[j];
    const std::vector<double> before = read;
    for (std::size_t j = 0; j + 1 < read.size(); ++j) {
      const double flow = 0.05 * (before[j] - before[j + 1]);
      read[j] -= flow;
      read[j + 1] += flow;
    }
    for (std::size_t j = 0; j < read.size(); ++j)
      press.readings[j] = made.gains[j] * read[j] + made.offsets[j];
  }
  SensorArray nominal = made.array;
  nominal.depths = {made.nominal_depth};
  const auto depth = [&](double stated) {
    return fit_presses(PressModel(nominal, made.nominal, stated), log).at(PadParameter::depth);
  };
  CHECK_THAT(depth(0.05).value, WithinRel(1.5e-3, 1e-3));
  CHECK(depth(0.0).value > 1.01 * 1.5e-3);  // an effective depth
}

TEST_CASE("gains are not identified where their mean is not, but about it") {
  const SimulatedLog made =
      simulated_log(40, {.knows_width = true, .knows_centre = true, .knows_force = false});
  const PressFit fit = fit_presses(made.model(), made.log);
  REQUIRE(fit.mean_gain.front().verdict == ValueVerdict::not_identifiable);
  CHECK(fit.gain[20].verdict == ValueVerdict::not_identifiable);
  CHECK(fit.gain_about_mean[20] == ValueVerdict::identified);
}

}  // namespace tactile_net
