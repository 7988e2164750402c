#include "tactile_net/calibration/press_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/calibration/simulated_log.hpp"
#include "tests/calibration/unknown_sd.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

/// What the fit had to find, in its own standard deviations.
struct Pull {
  double depth, thickness, nu;
};
Pull pull_of(const PressFit& fit, const SimulatedLog& log) {
  const auto of = [&](PadParameter parameter, double truth) {
    return (fit.at(parameter).value - truth) / fit.at(parameter).sd;
  };
  return {of(PadParameter::depth, log.array.depths.front()),
          of(PadParameter::thickness, log.truth.layer->thickness),
          of(PadParameter::poisson_ratio, log.truth.poisson_ratio)};
}

double depth_error(const PressFit& fit, const SimulatedLog& log) {
  return fit.at(PadParameter::depth).value / log.array.depths.front() - 1.0;
}

}  // namespace

TEST_CASE("a log without noise is explained and tells the truth") {
  SimulatedLog made = simulated_log(3, {.noise = 1e-9});
  CalibrationOptions options;
  options.depth_sd = options.thickness_sd = options.poisson_ratio_sd = unknown_sd;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  CHECK(fit.verdict == FitVerdict::ok);
  CHECK_THAT(fit.at(PadParameter::depth).value, WithinRel(1.5e-3, 1e-6));
  CHECK_THAT(fit.at(PadParameter::thickness).value, WithinRel(3e-3, 1e-6));
  CHECK_THAT(fit.at(PadParameter::poisson_ratio).value, WithinAbs(0.45, 1e-6));
  for (std::size_t j = 0; j < made.gains.size(); ++j)
    CHECK_THAT(fit.gains[j], WithinRel(made.gains[j], 1e-5));
}

TEST_CASE("over many logs the truth lies where the standard deviations say", "[long]") {
  const auto [knows_width, most] = GENERATE(table<bool, double>({{true, 0.0175}, {false, 0.048}}));
  constexpr unsigned logs = 40;
  double depth2 = 0.0, within = 0.0, rms = 0.0, pulls2 = 0.0;
  for (unsigned seed = 100; seed < 100 + logs; ++seed) {
    const SimulatedLog made =
        simulated_log(seed, {.knows_width = knows_width, .knows_centre = knows_width});
    CalibrationOptions options;
    options.starts = {1.0};
    const PressFit fit = fit_presses(made.model(), made.log, options);
    CAPTURE(seed, fit.rms);
    CHECK(fit.verdict == FitVerdict::ok);
    depth2 += std::pow(depth_error(fit, made), 2) / logs;
    rms += fit.rms / logs;
    const Pull pull = pull_of(fit, made);
    for (const double one : {pull.depth, pull.thickness, pull.nu}) {
      within += std::abs(one) < 1.96 ? 1.0 / (3.0 * logs) : 0.0;
      pulls2 += one * one / (3.0 * logs);
    }
  }
  CAPTURE(knows_width);
  // 120 pulls: 95 % of them within 1.96, give or take 2 % (one sd).
  CHECK(within > 0.89);
  CHECK(within <= 1.0);
  CHECK_THAT(pulls2, WithinAbs(1.0, 0.35));
  CHECK(std::sqrt(depth2) < most);
  CHECK_THAT(rms, WithinAbs(1.0, 0.02));
}

TEST_CASE("every start from 0.2 to 1.9 of the depth ends at one minimum where loads are known") {
  const SimulatedLog made = simulated_log(7);
  CalibrationOptions options;
  options.depth_sd = unknown_sd;
  options.starts = {1.0};
  const double best = fit_presses(made.model(), made.log, options).starts.front().objective;
  for (const double start : {0.2, 0.4, 0.7, 1.3, 1.9}) {
    options.starts = {start};
    const PressFit fit = fit_presses(made.model(), made.log, options);
    CAPTURE(start, fit.iterations);
    CHECK_THAT(fit.starts.front().objective, WithinRel(best, 1e-6));
  }
}

TEST_CASE("with nothing but the shape known a wrong minimum is never silent") {
  for (unsigned seed = 500; seed < 512; ++seed) {
    const SimulatedLog made = simulated_log(
        seed, {.noise = 0.003, .knows_width = false, .knows_centre = false, .knows_force = false});
    const PressFit fit = fit_presses(made.model(), made.log);
    CAPTURE(seed, fit.rms, depth_error(fit, made));
    const bool right = std::abs(pull_of(fit, made).depth) < 4.0;
    CHECK((right || fit.verdict != FitVerdict::ok));
    CHECK(fit.mean_gain.front().verdict == ValueVerdict::not_identifiable);
  }
}

TEST_CASE("an outlying reading and a wrong force are named, and move the depth little") {
  SimulatedLog made = simulated_log(11, {.knows_width = true});
  for (Press& press : made.log.presses) press.force.sd = 0.01 * *press.force.value;
  const PressFit clean = fit_presses(made.model(), made.log);
  const double noise = made.log.unloaded.rms.front();
  made.log.presses[4].readings[20] += 12.0 * noise;
  made.log.presses[9].readings[25] -= 12.0 * noise;
  made.log.presses[13].force.value = 1.5 * *made.log.presses[13].force.value;
  CalibrationOptions options;
  options.robust = true;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  const FittedValue& depth = clean.at(PadParameter::depth);
  CHECK(std::abs(fit.at(PadParameter::depth).value - depth.value) < depth.sd);
  const auto named = [&](std::size_t press, std::size_t reading) {
    return std::any_of(fit.outliers.begin(), fit.outliers.end(), [&](const OutlyingReading& one) {
      return one.press == press && one.reading == reading;
    });
  };
  CHECK(named(5, 20));
  CHECK(named(10, 25));
  for (const FittedPress& press : fit.presses) {
    CAPTURE(press.number);
    CHECK(press.put_aside ==
          (press.number == 14 ? std::optional(PressQuantity::force) : std::nullopt));
  }
  const FittedPress& freed = fit.presses[13];
  const double stated = *made.log.presses[13].force.value;
  CHECK_THAT(freed.force.value / stated, WithinAbs(1.0 / 1.5, 4.0 * freed.force.sd / stated));
}

TEST_CASE("a log in other units gives the same answer") {
  const SimulatedLog made = simulated_log(21, {.knows_centre = false});
  const PressFit si = fit_presses(made.model(), made.log);
  constexpr double length = 1e3, stress = 1e-6;  // mm, MPa; forces in N/mm
  SimulatedLog other = made;
  other.array.pitch *= length;
  other.nominal_depth *= length;
  other.nominal.youngs_modulus *= stress;
  other.nominal.layer->thickness *= length;
  for (auto* values :
       {&other.log.unloaded.mean, &other.log.unloaded.reading_rms, &other.log.unloaded.rms})
    for (double& value : *values) value *= stress;
  for (Press& press : other.log.presses) {
    for (double& value : press.readings) value *= stress;
    if (press.force.value) press.force.value = *press.force.value * length * stress;
    if (press.half_width.value) press.half_width.value = *press.half_width.value * length;
  }
  const PressFit scaled = fit_presses(other.model(), other.log);
  CHECK_THAT(scaled.at(PadParameter::depth).value / length,
             WithinRel(si.at(PadParameter::depth).value, 1e-8));
  CHECK_THAT(scaled.at(PadParameter::depth).sd / length,
             WithinRel(si.at(PadParameter::depth).sd, 1e-6));
  for (std::size_t j = 0; j < si.gains.size(); ++j)
    CHECK_THAT(scaled.gains[j], WithinRel(si.gains[j], 1e-8));
}

TEST_CASE("a parameter that is held stays, and its verdict says so") {
  const SimulatedLog made = simulated_log(8);
  CalibrationOptions options;
  options.poisson_ratio_sd = 0.0;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  CHECK(fit.at(PadParameter::poisson_ratio).value == made.nominal.poisson_ratio);
  CHECK(fit.at(PadParameter::poisson_ratio).verdict == ValueVerdict::fixed);
}

TEST_CASE("the misfit over the depth rises as the standard deviation says") {
  const SimulatedLog made = simulated_log(9);
  CalibrationOptions options;
  options.profile = true;
  const PressFit fit = fit_presses(made.model(), made.log, options);
  REQUIRE(fit.profile.size() == 13);
  const double scale = std::max(1.0, fit.rms);
  for (const ProfilePoint& point : fit.profile)
    CHECK_THAT(point.root, WithinAbs(point.z * scale, 0.25 * std::abs(point.z) + 0.02));
}

TEST_CASE("dead taxels are left out and their gains stay") {
  SimulatedLog made = simulated_log(10);
  for (Press& press : made.log.presses) press.readings[3] = 0.0;
  bool unread[41] = {};
  unread[3] = true;
  const PressFit fit = fit_presses(made.model(), made.log, {}, unread);
  CHECK(fit.verdict == FitVerdict::ok);
  CHECK(fit.gains[3] == 1.0);
  CHECK(fit.gain[3].verdict == ValueVerdict::fixed);
}

TEST_CASE("what cannot be fitted is refused with its reason") {
  SimulatedLog made = simulated_log(1, {.presses = 3});
  PressLog log = made.log;
  log.presses.clear();
  CHECK_THROWS_WITH(fit_presses(made.model(), log), ContainsSubstring("one press"));
  log = made.log;
  log.presses[1].readings.pop_back();
  CHECK_THROWS_WITH(fit_presses(made.model(), log), ContainsSubstring("press 2"));
  log = made.log;
  log.unloaded.rms = {0.0};
  CHECK_THROWS_WITH(fit_presses(made.model(), log), ContainsSubstring("no noise"));
  CHECK_THROWS_WITH(fit_presses(made.model(), made.log, {.depth_sd = -1.0}),
                    ContainsSubstring("depth_sd must be >= 0"));
}

}  // namespace tactile_net
