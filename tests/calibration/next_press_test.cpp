#include "tactile_net/calibration/next_press.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/calibration/rod_contact.hpp"
#include "tests/calibration/next_press_trial.hpp"
#include "tests/calibration/next_skin_press_trial.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

TEST_CASE("five chosen presses leave at most three quarters of what random ones do", "[long]") {
  const double chosen = trial_errors(PressChoice::chosen).readings;
  const double random = trial_errors(PressChoice::random).readings;
  CAPTURE(chosen, random);
  CHECK(chosen <= 0.75 * random);
  CHECK(chosen < trial_errors(PressChoice::none).readings);
}

TEST_CASE("a rod of the planned radius has the planned contact") {
  const SimulatedLog made = simulated_log(2, {.presses = 6});
  const PressModel model = made.model();
  const PressFit fit = fit_presses(model, made.log);
  Material pad = made.nominal;
  pad.poisson_ratio = fit.at(PadParameter::poisson_ratio).value;
  pad.layer->thickness = fit.at(PadParameter::thickness).value;
  for (const NextPress& press : next_presses(model, made.log, {}, fit, 3).presses)
    CHECK_THAT(rod_half_width(pad, press.force, press.radius), WithinRel(press.half_width, 1e-9));
}

namespace {

/// A skin's log of balls, punches and cones, and its fit.
struct SkinCase {
  SimulatedSkinLog made;
  PressModel model;
  PressFit fit;
};

SkinCase skin_case(const SkinLogOptions& options) {
  SimulatedSkinLog made = simulated_skin_log(11, options);
  PressModel model = made.model();
  PressFit fit = fit_presses(model, made.log);
  return {std::move(made), std::move(model), std::move(fit)};
}

}  // namespace

TEST_CASE("five presses chosen on a skin leave at most three quarters of what random ones do",
          "[long]") {
  using Trial = NextSkinPressTrial;
  const double chosen = trial_errors<Trial>(PressChoice::chosen).readings;
  const double random = trial_errors<Trial>(PressChoice::random).readings;
  CAPTURE(chosen, random);
  CHECK(chosen <= 0.75 * random);
  CHECK(chosen < trial_errors<Trial>(PressChoice::none).readings);
}

TEST_CASE("what planned presses on a skin promise is what a fit with them has", "[long]") {
  const auto target =
      GENERATE(std::optional<PadParameter>{}, std::optional<PadParameter>{PadParameter::depth});
  double ratio = 0.0;
  constexpr unsigned logs = 6;
  for (unsigned seed = 0; seed < logs; ++seed) {
    const NextSkinPressTrial::Promise one = NextSkinPressTrial(8000 + seed).promise(target);
    CAPTURE(seed, one.now, one.said, one.kept);
    CHECK(one.said < 0.8 * one.now);
    CHECK_THAT(one.kept, WithinRel(one.said, 0.15));
    ratio += one.kept / one.said / logs;
  }
  CHECK_THAT(ratio, WithinRel(1.0, 0.08));
}

TEST_CASE("presses on a skin are planned within it, by balls that have the planned contacts") {
  const SkinCase skin = skin_case({.presses = 6});
  Material pad = skin.made.nominal_pad;
  pad.poisson_ratio = skin.fit.at(PadParameter::poisson_ratio).value;
  pad.youngs_modulus = skin.fit.at(PadParameter::youngs_modulus).value;
  double now = next_presses(skin.model, skin.made.log, {}, skin.fit, 0).now;
  for (const NextPress& press : next_presses(skin.model, skin.made.log, {}, skin.fit, 4).presses) {
    CHECK(press.disc == DiscProfile::sphere);
    CHECK(std::max(std::abs(press.position), std::abs(press.position_z)) < 4e-3);
    CHECK_THAT(ball_contact_radius(pad, press.force, press.radius),
               WithinRel(press.half_width, 1e-9));
    CHECK(press.remaining < now);
    now = press.remaining;
  }
}

TEST_CASE("a skin's gains that no press reached are where the next presses go") {
  // Seven presses, all in the half with z < 0.
  SimulatedSkinLog made = simulated_skin_log(12, {.presses = 16});
  std::erase_if(made.log.presses,
                [](const Press& press) { return *press.position_z.value > -1e-3; });
  REQUIRE(made.log.presses.size() > 4);
  const PressModel model = made.model();
  const PressFit fit = fit_presses(model, made.log);
  const NextPresses next = next_presses(model, made.log, {}, fit, 2);
  for (const NextPress& press : next.presses) CHECK(press.position_z > 0.0);
}

TEST_CASE("a skin's next presses are the same again, and their search says how far it is") {
  const SkinCase skin = skin_case({.presses = 6});
  std::vector<std::size_t> said;
  const auto plan = [&] {
    return next_presses(skin.model, skin.made.log, {}, skin.fit, 3, PadParameter::depth,
                        [&](std::size_t search) { said.push_back(search); });
  };
  const NextPresses one = plan();
  REQUIRE(said.size() >= 6);
  for (std::size_t i = 0; i < said.size(); ++i) CHECK(said[i] == i + 1);
  const NextPresses other = plan();
  REQUIRE(one.presses.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(one.presses[i].position == other.presses[i].position);
    CHECK(one.presses[i].position_z == other.presses[i].position_z);
    CHECK(one.presses[i].remaining == other.presses[i].remaining);
  }
  // Nothing is sought where it may be stopped.
  CHECK_THROWS_AS(next_presses(skin.model, skin.made.log, {}, skin.fit, 3, {},
                               [](std::size_t) { throw std::runtime_error("stopped"); }),
                  std::runtime_error);
}

TEST_CASE("a target that a skin's log holds is refused by name") {
  const SkinCase skin = skin_case({.presses = 6});
  CHECK_THROWS_WITH(next_presses(skin.model, skin.made.log, {}, skin.fit, 1, PadParameter::shift_z),
                    ContainsSubstring("the target shift_z is fixed"));
}

}  // namespace tactile_net
