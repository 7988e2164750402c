/// @file
/// Curved skins calibrated from presses by balls: logs whose truth is known, of readings that are
/// sums of point loads.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tactile_net/calibration/press_fit.hpp"
#include "tests/calibration/simulated_skin_log.hpp"
#include "tests/calibration/unknown_sd.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

using enum Quantity;

CalibrationOptions from_one_start() {
  CalibrationOptions options;
  options.starts = {1.0};
  return options;
}

/// How many of its deviations a value lies from the truth.
double pull_of(const PressFit& fit, PadParameter parameter, double truth) {
  return (fit.at(parameter).value - truth) / fit.at(parameter).sd;
}

}  // namespace

TEST_CASE("a dome's log without noise tells depth, thickness, nu, E and gains") {
  const double radius = GENERATE(16e-3, -40e-3);
  const SimulatedSkinLog made = simulated_skin_log(3, {.side = 4,
                                                       .noise = 1e-9,
                                                       .presses = 12,
                                                       .reads = {stress_x, strain_y},
                                                       .layer = true,
                                                       .dome = radius});
  PressLog log = made.log;
  const auto force = log.presses[0].force.value;
  for (Press& press : log.presses) press.force = press.position = press.position_z = {};
  log.presses[0].force.value = force;  // stated within 1 %: it tells the common gain
  CalibrationOptions options = from_one_start();
  options.depth_sd = options.thickness_sd = options.poisson_ratio_sd = unknown_sd;
  options.youngs_modulus_sd = unknown_sd;
  options.half_width_sd = 0.0;
  const PressFit fit = fit_presses(made.model(), log, options);
  CAPTURE(radius, fit.rms, fit.chi_squared, fit.dof);
  CHECK_THAT(fit.at(PadParameter::depth).value, WithinRel(1.8e-3, 1e-4));
  CHECK_THAT(fit.at(PadParameter::thickness).value, WithinRel(4e-3, 1e-3));
  CHECK_THAT(fit.at(PadParameter::poisson_ratio).value, WithinAbs(0.46, 1e-3));
  const double scale = fit.at(PadParameter::youngs_modulus).value / 2.2e5;
  CHECK_THAT(scale, WithinAbs(1.0, 0.03));
  for (std::size_t j = 0; j < made.gains.size(); ++j)
    CHECK_THAT(fit.gains[j], WithinRel(made.gains[j] / (j < 16 ? scale : 1.0), 1e-3));
}

TEST_CASE("over many logs of domes the truth lies where the standard deviations say") {
  constexpr unsigned logs = 24;
  double pulls2 = 0.0, within = 0.0, count = 0.0, rms = 0.0;
  double gains_within = 0.0, gains2 = 0.0, gains = 0.0;
  for (unsigned seed = 1; seed <= logs; ++seed) {
    const SimulatedSkinLog made = simulated_skin_log(
        seed, {.presses = 10, .reads = {stress_x, shear_xy}, .layer = true, .dome = 15e-3});
    const PressFit fit = fit_presses(made.model(), made.log, from_one_start());
    CAPTURE(seed, fit.rms);
    CHECK(fit.verdict == FitVerdict::ok);
    rms += fit.rms / logs;
    for (const auto& [parameter, truth] :
         {std::pair{PadParameter::depth, 1.8e-3}, std::pair{PadParameter::thickness, 4e-3},
          std::pair{PadParameter::poisson_ratio, 0.46},
          std::pair{PadParameter::youngs_modulus, 2.2e5}}) {
      const double pull = pull_of(fit, parameter, truth);
      CAPTURE(name(parameter), fit.at(parameter).value, fit.at(parameter).sd);
      CHECK(std::abs(pull) < 4.0);
      pulls2 += pull * pull;
      within += std::abs(pull) < 1.96 ? 1.0 : 0.0;
      count += 1.0;
    }
    CHECK(fit.at(PadParameter::depth).verdict == ValueVerdict::identified);
    for (std::size_t j = 0; j < made.gains.size(); ++j) {
      const double pull = (fit.gains[j] - made.gains[j]) / fit.gain[j].sd;
      gains2 += pull * pull;
      gains_within += std::abs(pull) < 1.96 ? 1.0 : 0.0;
      gains += 1.0;
    }
  }
  CAPTURE(pulls2 / count, within / count, gains_within / gains, rms);
  // Nominal nu and E are the truth, or 9 % from it, whatever their priors: they hardly vary.
  CHECK(within / count > 0.9);
  CHECK(pulls2 / count < 1.3);
  CHECK(pulls2 / count > 0.2);
  CHECK_THAT(rms, WithinAbs(1.0, 0.03));
  CHECK_THAT(gains_within / gains, WithinAbs(0.95, 0.03));
  CHECK(gains2 / gains < 1.15);
  CHECK(gains2 / gains > 0.7);
}

TEST_CASE("taken for flat a dome's log gives another depth, and a poor fit") {
  const SimulatedSkinLog made = simulated_skin_log(
      2, {.presses = 12, .reads = {stress_x, shear_xy}, .layer = true, .dome = 12e-3});
  SkinArray flat{.rows = 5,
                 .columns = 5,
                 .pitch_y = 2e-3,
                 .pitch_z = 2e-3,
                 .depths = {1.5e-3},
                 .reads = {stress_x, shear_xy}};
  const PressFit fit = fit_presses(PressModel(flat, made.nominal_pad), made.log, from_one_start());
  CAPTURE(fit.rms, fit.at(PadParameter::depth).value, fit.at(PadParameter::depth).sd);
  CHECK((fit.verdict == FitVerdict::poor_fit ||
         std::abs(pull_of(fit, PadParameter::depth, 1.8e-3)) > 4.0));
}

TEST_CASE("a log on a skin that is hardly curved gives the flat skin's fit") {
  const SimulatedSkinLog made =
      simulated_skin_log(7, {.presses = 10, .reads = {stress_x, shear_xy}, .layer = true});
  const SkinArray hardly = dome({.radius = 1e5, .depth = 1.5e-3, .reads = {stress_x, shear_xy}});
  const PressFit flat = fit_presses(made.model(), made.log, from_one_start());
  const PressFit curved =
      fit_presses(PressModel(hardly, made.nominal_pad), made.log, from_one_start());
  for (const PadParameter parameter : {PadParameter::depth, PadParameter::thickness,
                                       PadParameter::poisson_ratio, PadParameter::youngs_modulus}) {
    CAPTURE(name(parameter));
    CHECK_THAT(curved.at(parameter).value, WithinRel(flat.at(parameter).value, 1e-6));
    CHECK_THAT(curved.at(parameter).sd, WithinRel(flat.at(parameter).sd, 1e-5));
    CHECK(curved.at(parameter).verdict == flat.at(parameter).verdict);
  }
  for (std::size_t j = 0; j < flat.gains.size(); ++j) {
    CHECK_THAT(curved.gains[j], WithinRel(flat.gains[j], 1e-6));
    CHECK_THAT(curved.offsets[j], WithinAbs(flat.offsets[j], 1e-6 * made.rms[0]));
  }
  CHECK_THAT(curved.chi_squared, WithinRel(flat.chi_squared, 1e-6));
}

TEST_CASE("a turned and moved dome gives the same values from the same log") {
  const SkinLogOptions how{
      .presses = 8, .reads = {stress_x, shear_xz}, .layer = true, .friction = 0.3, .dome = 18e-3};
  SkinLogOptions elsewhere = how;
  elsewhere.stand = turned_stand();
  const SimulatedSkinLog made = simulated_skin_log(11, how);
  const SimulatedSkinLog there = simulated_skin_log(11, elsewhere);
  const PressFit fit = fit_presses(made.model(), made.log, from_one_start());
  const PressFit same = fit_presses(there.model(), there.log, from_one_start());
  for (const PadParameter parameter : {PadParameter::depth, PadParameter::thickness,
                                       PadParameter::poisson_ratio, PadParameter::youngs_modulus})
    CHECK_THAT(same.at(parameter).value, WithinRel(fit.at(parameter).value, 1e-7));
  for (std::size_t j = 0; j < fit.gains.size(); ++j)
    CHECK_THAT(same.gains[j], WithinRel(fit.gains[j], 1e-7));
}

TEST_CASE("what a dome's log cannot tell is said by name, and keeps its value") {
  const auto part = [](const PressFit& fit, PadParameter parameter) {
    double most = 0.0;
    for (const NullDirection& direction : fit.null_directions)
      most = std::max(most, std::abs(direction.pad[static_cast<std::size_t>(parameter)]));
    return most;
  };
  SECTION("one press leaves depth, thickness and nu to the pattern of the gains") {
    const SimulatedSkinLog made =
        simulated_skin_log(9, {.presses = 1, .layer = true, .states_radius = false, .dome = 15e-3});
    const PressFit fit = fit_presses(made.model(), made.log);
    for (const PadParameter parameter :
         {PadParameter::depth, PadParameter::thickness, PadParameter::poisson_ratio}) {
      CAPTURE(name(parameter));
      CHECK(part(fit, parameter) > 0.1);
      CHECK(fit.at(parameter).verdict != ValueVerdict::identified);
    }
    // A gain takes part in what is hidden, too.
    double gains = 0.0;
    for (const NullDirection& direction : fit.null_directions)
      for (const double gain : direction.gains) gains = std::max(gains, std::abs(gain));
    CHECK(gains > 0.1);
  }
  SECTION("stresses under contacts of known radius do not see E") {
    const SimulatedSkinLog made = simulated_skin_log(
        9, {.presses = 12, .layer = true, .states_radius = false, .dome = 15e-3});
    const PressFit fit = fit_presses(made.model(), made.log, from_one_start());
    CHECK(fit.null_directions.size() == 1);
    CHECK(fit.at(PadParameter::youngs_modulus).verdict == ValueVerdict::not_identifiable);
    CHECK(fit.at(PadParameter::youngs_modulus).value == 2e5);
    CHECK(fit.at(PadParameter::depth).verdict == ValueVerdict::identified);
  }
  SECTION("no position hides the place on the stage alone") {
    SimulatedSkinLog made = simulated_skin_log(
        21, {.presses = 12, .reads = {stress_x, shear_xy}, .layer = true, .dome = 15e-3});
    for (Press& press : made.log.presses) press.position = press.position_z = {};
    CalibrationOptions options = from_one_start();
    options.shift_sd = options.shift_z_sd = 1e-3;
    const PressFit fit = fit_presses(made.model(), made.log, options);
    CHECK(fit.at(PadParameter::shift).verdict == ValueVerdict::not_identifiable);
    CHECK(fit.at(PadParameter::shift_z).verdict == ValueVerdict::not_identifiable);
    CHECK(fit.at(PadParameter::depth).verdict == ValueVerdict::identified);
  }
}

TEST_CASE("a dome's dead and stuck taxels are named, and left out the rest is found") {
  SimulatedSkinLog made = simulated_skin_log(
      5, {.presses = 14, .reads = {stress_x, shear_xy}, .layer = true, .dome = 15e-3});
  constexpr std::size_t dead = 7, stuck = 16;
  for (std::size_t p = 0; p < made.log.presses.size(); ++p) {
    // The dead one has noise alone; the stuck one stays where it was, give or take its noise.
    const double noise = made.rms[0] * (p % 2 == 0 ? 1.0 : -1.0);
    made.log.presses[p].readings[dead] = made.log.unloaded.mean[dead] + noise;
    made.log.presses[p].readings[stuck] = made.log.unloaded.mean[stuck] + 1e-3 * noise;
  }
  const PressFit poor = fit_presses(made.model(), made.log, from_one_start());
  CHECK(poor.verdict == FitVerdict::poor_fit);
  CHECK(poor.doubtful_readings == std::vector<std::size_t>{dead, stuck});
  const auto unread = std::make_unique<bool[]>(made.gains.size());
  unread[dead] = unread[stuck] = true;
  const PressFit fit = fit_presses(made.model(), made.log, from_one_start(),
                                   std::span(unread.get(), made.gains.size()));
  CHECK(fit.verdict == FitVerdict::ok);
  CHECK(std::abs(pull_of(fit, PadParameter::depth, 1.8e-3)) < 3.0);
  CHECK(std::abs(pull_of(fit, PadParameter::thickness, 4e-3)) < 3.0);
}

TEST_CASE("places of a curved skin's taxels are exact, and a pitch that is free is refused") {
  const SimulatedSkinLog made = simulated_skin_log(4, {.presses = 4, .layer = true, .dome = 15e-3});
  CalibrationOptions options;
  options.pitch_sd = 0.01;
  CHECK_THROWS_WITH(fit_presses(made.model(), made.log, options), ContainsSubstring("pitch_sd"));
}

}  // namespace tactile_net
