#include "report/words/calibration_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "report/load_dimension.hpp"
#include "report/words/calibration_parts.hpp"
#include "report/words/check_parts.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {
namespace {

std::string quantity_in_words(const lab::SceneCalibration& found, PressQuantity quantity,
                              double value, double sd) {
  switch (quantity) {
    case PressQuantity::force:
      return in_unit(found.units(), load_dimension(found.is_skin()), value, sd);
    case PressQuantity::position:
    case PressQuantity::half_width:
    case PressQuantity::position_z:
      return in_unit(found.units(), Dimension::length, value, sd);
    case PressQuantity::friction:
    case PressQuantity::friction_z:
      break;
  }
  return plus_minus(value, sd);
}

const Press& press_of(const lab::SceneCalibration& found, std::size_t number) {
  return *std::find_if(found.log.presses.begin(), found.log.presses.end(),
                       [&](const Press& press) { return press.number == number; });
}

std::string put_aside_in_words(const lab::SceneCalibration& found, const FittedPress& press) {
  const PressQuantity quantity = *press.put_aside;
  const Press& log = press_of(found, press.number);
  const Stated* const stated[] = {&log.force,    &log.position,   &log.half_width,
                                  &log.friction, &log.position_z, &log.friction_z};
  const double said = stated[static_cast<std::size_t>(quantity)]->value.value_or(0.0);
  const ValueWithSd& value = press.at(quantity);
  std::string text = "Press " + std::to_string(press.number) + " does not fit its stated " +
                     spoken_name(name(quantity)) + ": it was ";
  if (quantity == PressQuantity::force)
    text += plus_minus(value.value / said, value.sd / said) + " of it";
  else
    text += quantity_in_words(found, quantity, value.value, value.sd) + ", and " +
            quantity_in_words(found, quantity, said, 0.0) + " was stated";
  return text + ". The stated one was put aside.";
}

void say_contradicted_presses(const lab::SceneCalibration& found, std::vector<std::string>& text) {
  constexpr std::size_t most = 3;
  const std::vector<ContradictedPress>& all = found.fit.contradicted_presses;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) {
    const ContradictedPress& one = all[i];
    std::string sentence = "Press " + std::to_string(one.press) + ": its readings contradict the " +
                           spoken_name(name(one.quantity)) + " that is stated, " +
                           quantity_in_words(found, one.quantity, one.stated, 0.0);
    sentence += one.deviation != 0.0
                    ? ", by " + brief(std::abs(one.deviation)) + " of its standard deviations"
                    : "; " + std::to_string(one.readings) +
                          " of them are more than 5 standard deviations off";
    text.push_back(sentence + (found.options.robust
                                   ? "."
                                   : "; " + option(Option::robust) + " lets it count less."));
  }
  if (all.size() > most)
    text.push_back(std::to_string(all.size() - most) +
                   " more presses contradict what the log states of them.");
}

void say_doubtful_readings(const lab::SceneCalibration& found, std::vector<std::string>& text) {
  const PressFit& fit = found.fit;
  const std::vector<std::string>& names = found.readings;
  for (const std::size_t j : fit.doubtful_readings)
    text.push_back(
        "The gain of " + names[j] + " ended at " + brief(fit.gains[j]) +
        ", far from the others': a dead, stuck or loose taxel? List taxel " +
        std::visit([&](const auto& scene) { return index_of(scene, found.sites[j].taxel); },
                   found.scene) +
        " in [dead_taxels], or state a larger gain_sd.");
}

/// "forces", "half widths" of presses.
std::string plural(PressQuantity quantity) {
  return quantity == PressQuantity::friction ? "frictions" : spoken_name(name(quantity)) + 's';
}

std::string understated_in_words(const UnderstatedSd& one) {
  const bool is_place =
      one.quantity == PressQuantity::position || one.quantity == PressQuantity::position_z;
  return "The stated " + plural(one.quantity) + " are " + fixed(one.rms, 1) +
         " times less certain than stated, over " + std::to_string(one.presses) + " presses (p " +
         brief(one.p) + "), or " +
         (is_place ? "the taxels lie elsewhere than the scene says (pitch)"
                   : "gains changed from press to press (temperature, creep)") +
         ". State larger standard deviations; all that are found here are too small.";
}

/// Depth and thickness make up for a base of the wrong kind, and residuals hardly tell.
void say_other_base(const lab::SceneCalibration& found, std::vector<std::string>& text) {
  constexpr double clear = 6.0;  // in the sum of squares, for one base to be the likelier
  if (found.other_base_gain && *found.other_base_gain > -clear) {
    const bool bonded = found.material().layer->base == Base::bonded;
    const std::string own = bonded ? "bonded" : "slipping";
    const std::string other = bonded ? "slipping" : "bonded";
    text.push_back(*found.other_base_gain > clear
                       ? "A " + other + " base explains these presses better than a " + own +
                             " one (the sum of squares is less by " +
                             brief(*found.other_base_gain) + "): is [material] layer.base right?"
                       : "A " + other + " base explains these presses as well as a " + own +
                             " one: depth and thickness hold if [material] layer.base does.");
  }
}

constexpr double surprising = 2.0;  // stated sds of a parameter, to be said

/// What is no contradiction, and yet not what the scene leads one to expect: forces that are all
/// twice too large end as gains of a half, and nothing else shows.
void say_surprises(const lab::SceneCalibration& found, std::vector<std::string>& text) {
  const PressFit& fit = found.fit;
  const auto said = [](const auto& contradicted, auto one) {
    return std::find(contradicted.begin(), contradicted.end(), one) != contradicted.end();
  };
  for (const PadParameter parameter : fit.free) {
    const double sd = found.options.sd(parameter);
    const FittedValue& value = fit.at(parameter);
    const double away = deviation_from_stated(parameter, value, sd);
    if (away > surprising && !said(fit.contradicted, parameter))
      text.push_back("The " + spoken_parameter(parameter, found.is_skin()) + " is " +
                     fixed(away, 1) +
                     " stated standard deviations from the stated one: is the scene that far off?");
  }
  for (std::size_t c = 0; c < fit.mean_gain.size(); ++c) {
    const double away = std::abs(std::log(fit.mean_gain[c].value)) / found.options.mean_gain_sd;
    if (away > surprising && !said(fit.contradicted_gains, c))
      text.push_back("The mean gain of " + found.channels[c].name + " is " +
                     brief(fit.mean_gain[c].value) + ", " + fixed(away, 1) +
                     " stated standard deviations from 1: do the readings' scale, the forces (load "
                     "cell, units) and the " +
                     (found.is_skin() ? "balls" : "rod's length") +
                     " hold? Forces that are wrong by a factor, or diameters given as radii, have "
                     "this effect.");
  }
}

std::string trend_in_words(const TimeTrend& trend) {
  const std::string numbers =
      " (rank correlation " + fixed(trend.correlation, 2) + ", p " + brief(trend.p) + ")";
  switch (trend.of) {
    case TrendOf::size:
      return "Residuals " + std::string(trend.correlation > 0.0 ? "grow" : "shrink") +
             " from press to press" + numbers + ": creep, temperature, or wear?";
    case TrendOf::gain:
      return "Readings " + std::string(trend.correlation > 0.0 ? "grow" : "shrink") +
             " from press to press under like loads" + numbers +
             ": creep, temperature, or a load cell that drifts?";
    case TrendOf::offset:
      break;
  }
  return "Offsets " + std::string(trend.correlation > 0.0 ? "grow" : "shrink") +
         " from press to press" + numbers + ": temperature? Log unloaded rows in between.";
}

}  // namespace

std::vector<std::string> doubts_in_words(const lab::SceneCalibration& found) {
  std::vector<std::string> text;
  say_surprises(found, text);
  say_contradicted_presses(found, text);
  say_doubtful_readings(found, text);
  for (const UnderstatedSd& one : found.fit.understated) text.push_back(understated_in_words(one));
  for (const FittedPress& press : found.fit.presses)
    if (press.put_aside) text.push_back(put_aside_in_words(found, press));
  say_other_base(found, text);
  if (found.fit.time_trend.is_significant()) text.push_back(trend_in_words(found.fit.time_trend));
  return text;
}

}  // namespace tactile_net::report
