#include "tactile_net/calibration/next_press.hpp"

#include "tactile_net/calibration/rod_contact.hpp"
#include "tests/calibration/next_press_trial.hpp"
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

}  // namespace tactile_net
