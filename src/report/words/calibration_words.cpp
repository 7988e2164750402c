#include "tactile_net/report/words/calibration_words.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <variant>

#include "report/words/calibration_doubts.hpp"
#include "report/words/calibration_parts.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {
namespace {

constexpr double share_limit = 1e-3;  // of a null direction, to be said

std::optional<Dimension> dimension(PadParameter parameter) {
  switch (parameter) {
    case PadParameter::depth:
    case PadParameter::thickness:
    case PadParameter::shift:
    case PadParameter::shift_z:
    case PadParameter::pitch:
      return Dimension::length;
    case PadParameter::youngs_modulus:
      return Dimension::stress;
    default:
      return std::nullopt;
  }
}

/// The parameter belongs to this scene: it was free, or nothing can be known of it.
bool is_shown(const lab::SceneCalibration& found, PadParameter parameter) {
  const FittedValue& value = found.fit.at(parameter);
  if (parameter == PadParameter::thickness) return found.material().layer.has_value();
  if (parameter == PadParameter::depth || parameter == PadParameter::poisson_ratio ||
      parameter == PadParameter::youngs_modulus)
    return true;
  return value.verdict != ValueVerdict::fixed;
}

std::string number(const lab::SceneCalibration& found, PadParameter parameter, double value) {
  const auto which = dimension(parameter);
  return which ? in_unit(found.units(), *which, value) : brief(value);
}

std::string number(const lab::SceneCalibration& found, PadParameter parameter, double value,
                   double sd) {
  if (!std::isfinite(sd) || sd == 0.0) return number(found, parameter, value);
  const auto which = dimension(parameter);
  return which ? in_unit(found.units(), *which, value, sd) : plus_minus(value, sd);
}

/// "9 to 14, 20" of indices.
std::string runs(const std::vector<std::size_t>& indices) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < indices.size();) {
    std::size_t end = i;
    while (end + 1 < indices.size() && indices[end + 1] == indices[end] + 1) ++end;
    const char* const between = end == i + 1 ? ", " : " to ";
    parts.push_back(std::to_string(indices[i]) +
                    (end > i ? between + std::to_string(indices[end]) : ""));
    i = end + 1;
  }
  return join(parts, ", ");
}

bool all_forces_unknown(const PressLog& log) {
  return std::none_of(log.presses.begin(), log.presses.end(),
                      [](const Press& press) { return press.force.value.has_value(); });
}

/// "Gains of readings 3, 4 are", "The gain of reading 3 is".
std::string gains_are(const std::vector<std::size_t>& readings) {
  return readings.size() == 1 ? "The gain of reading " + runs(readings) + " is"
                              : "Gains of readings " + runs(readings) + " are";
}

std::string words_of(const lab::SceneCalibration& found, const NullDirection& direction) {
  std::vector<std::string> parts;
  bool modulus = false;
  bool only_modulus = true;
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (std::abs(direction.pad[i]) > share_limit) {
      const auto parameter = static_cast<PadParameter>(i);
      parts.push_back(spoken_parameter(parameter, found.is_skin()));
      modulus = modulus || parameter == PadParameter::youngs_modulus;
      only_modulus = only_modulus && parameter == PadParameter::youngs_modulus;
    }
  std::vector<std::size_t> gains;
  for (std::size_t j = 0; j < direction.gains.size(); ++j)
    if (std::abs(direction.gains[j]) > 0.02) gains.push_back(j);
  const bool few = !gains.empty() && gains.size() * 4 < direction.gains.size();
  const bool forces = all_forces_unknown(found.log);
  if (parts.empty() && few)
    return "Readings " + runs(gains) +
           " say nothing: no press reached them. Their gains stay what the scene states; press "
           "there.";
  if (parts.empty() && forces)
    return "The common gain cannot be told from the forces, which the log does not state: gains "
           "are known relative to each other. State one force.";
  if (parts.empty()) return "The gains of readings " + runs(gains) + " cannot be told apart.";
  const std::string rods = found.is_skin() ? "balls'" : "rods'";
  const bool strains = std::any_of(
      found.channels.begin(), found.channels.end(),
      [](const Channel& channel) { return traits(channel.quantity).kind != QuantityKind::stress; });
  if (modulus && only_modulus && gains.empty() && strains)
    return "Young's modulus cannot be told from forces that are not stated: both scale the "
           "readings. State one force, and the " +
           rods + " radius.";
  if (modulus && only_modulus && gains.empty())
    return "Young's modulus has no effect on these readings: stresses follow the forces, whatever "
           "the pad's stiffness. Give the " +
           rods +
           " radius, or its value from elsewhere; "
           "tractions from stresses do not depend on it.";
  if (modulus && only_modulus)
    return "Young's modulus cannot be told from the gains" +
           std::string(forces ? ", nor both from the forces" : "") +
           ": all of them together scale the readings. Give the " + rods +
           " radius, or the modulus.";
  if (parts.size() == 1 && gains.empty())
    return "The " + parts.front() + " has no effect on these readings" +
           (parts.front() == spoken_parameter(PadParameter::shift, found.is_skin()) ||
                    parts.front() == spoken_parameter(PadParameter::shift_z, found.is_skin())
                ? ": no position is stated. State one."
                : ": it keeps the value that the scene states.");
  return join(parts, ", ") + (gains.empty() ? "" : " and gains") +
         " cannot be told apart by these presses: what is known of each follows from what the "
         "scene "
         "states of the others. State positions, widths or forces, or press at other places with "
         "other widths.";
}

}  // namespace

std::vector<std::vector<std::string>> calibration_cells(const lab::SceneCalibration& found) {
  std::vector<std::vector<std::string>> rows = {{"parameter", "verdict", "stated", "found"}};
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const auto parameter = static_cast<PadParameter>(i);
    if (!is_shown(found, parameter)) continue;
    const FittedValue& value = found.fit.at(parameter);
    rows.push_back(
        {spoken_parameter(parameter, found.is_skin()), spoken_name(name(value.verdict)),
         number(found, parameter, value.nominal, value.prior_sd),
         value.verdict == ValueVerdict::not_identifiable || value.verdict == ValueVerdict::fixed
             ? "-"
             : number(found, parameter, value.value, value.sd)});
  }
  for (std::size_t c = 0; c < found.fit.mean_gain.size(); ++c) {
    const FittedValue& value = found.fit.mean_gain[c];
    rows.push_back({"mean gain of " + found.channels[c].name, spoken_name(name(value.verdict)),
                    plus_minus(1.0, value.prior_sd),
                    value.verdict == ValueVerdict::not_identifiable
                        ? "-"
                        : plus_minus(value.value, value.sd)});
  }
  return rows;
}

std::string calibrated_in_words(const lab::SceneCalibration& found) {
  return std::visit(
      [](const auto& scene) { return sensor_in_words(scene) + "; " + material_in_words(scene); },
      found.scene);
}

std::string in_words(const lab::SceneCalibration& found, const NullDirection& direction) {
  return words_of(found, direction);
}

std::vector<std::string> null_directions_in_words(const lab::SceneCalibration& found) {
  std::vector<std::string> sentences;
  for (const NullDirection& direction : found.fit.null_directions)
    if (std::string text = words_of(found, direction);
        std::find(sentences.begin(), sentences.end(), text) == sentences.end())
      sentences.push_back(std::move(text));
  return sentences;
}

std::vector<std::string> calibration_in_words(const lab::SceneCalibration& found) {
  const PressFit& fit = found.fit;
  std::vector<std::string> text;
  const std::string residuals = "Residuals are " + fixed(fit.rms, 2) +
                                " times the noise (chi-squared " + brief(fit.chi_squared) + " on " +
                                brief(fit.dof) + " degrees of freedom)";
  const std::string written =
      found.forced ? "the scene is written all the same, by " + option(Option::force) + "."
                   : "nothing is written without " + option(Option::force) + ".";
  switch (fit.verdict) {
    case FitVerdict::ok:
      text.push_back(residuals + ": the model explains the presses.");
      break;
    case FitVerdict::iteration_limit:
      text.push_back("No start converged in " + std::to_string(found.options.most_iterations) +
                     " iterations: nothing here is to be trusted, and " + written);
      break;
    case FitVerdict::poor_fit:
      text.push_back(residuals + ": the fit is poor, and " + written);
  }
  for (const PadParameter parameter : fit.contradicted)
    text.push_back("The " + spoken_parameter(parameter, found.is_skin()) +
                   " ended more than 4 of its stated standard deviations away: units, swapped "
                   "columns, or a pad of another kind?");
  for (const std::size_t channel : fit.contradicted_gains)
    text.push_back("The mean gain of " + found.channels[channel].name + " ended at " +
                   brief(fit.mean_gain[channel].value) +
                   ", more than 4 stated standard deviations from 1: units of the forces or of "
                   "the readings, or swapped columns?");
  for (std::string& sentence : doubts_in_words(found)) text.push_back(std::move(sentence));
  if (fit.rms >= 1.005)
    text.push_back("Standard deviations are multiplied by " + fixed(fit.rms, 2) +
                   ", for what the model does not explain.");
  std::vector<std::size_t> weak;
  std::vector<std::size_t> prior_only;
  for (std::size_t j = 0; j < fit.gain.size(); ++j) {
    if (fit.gain_about_mean[j] == ValueVerdict::weak) weak.push_back(j);
    if (fit.gain_about_mean[j] == ValueVerdict::prior_only) prior_only.push_back(j);
  }
  if (!weak.empty())
    text.push_back(gains_are(weak) + " weak: press nearer to " +
                   (weak.size() == 1 ? "it." : "them."));
  if (!prior_only.empty())
    text.push_back(gains_are(prior_only) + " known from the scene alone: no press determines " +
                   (prior_only.size() == 1 ? "it." : "them."));
  const std::vector<std::string>& names = found.readings;
  std::size_t told = 0;
  for (const OutlyingReading& one : fit.outliers)
    if (++told <= 5)
      text.push_back("Press " + std::to_string(one.press) + ", " + names[one.reading] +
                     ": a reading " + brief(one.deviation) + " standard deviations off" +
                     (found.options.robust
                          ? ", which counts little."
                          : "; " + option(Option::robust) + " lets it count less."));
  if (told > 5)
    text.push_back(std::to_string(told - 5) +
                   " more readings are more than 5 standard deviations off.");
  for (const FittedPress& press : fit.presses)
    if (press.half_width_at_bound)
      text.push_back("Press " + std::to_string(press.number) +
                     " is narrower than a tenth of the depth: its width is not seen.");
  if (found.spread < fit.at(PadParameter::depth).nominal && fit.presses.size() > 1)
    text.push_back("All presses are at about one place: press over the whole " +
                   std::string(found.is_skin() ? "skin, small and large balls"
                                               : "array, narrow and wide rods") +
                   " in turn, as hard as allowed.");
  for (const ProfilePoint& point : fit.profile)
    if (point.z != 0.0 && std::abs(point.root / point.z - 1.0) > 0.3) {
      text.emplace_back(
          "The misfit is not a parabola in the depth, so the standard deviation of the depth is "
          "only a rough guide.");
      break;
    }
  return text;
}

std::vector<Answer> answers(const lab::SceneCalibration& found) {
  const PressFit& fit = found.fit;
  std::vector<Answer> boxes;
  boxes.push_back({fit.verdict == FitVerdict::ok ? "fits" : spoken_name(name(ValueVerdict::weak)),
                   "residuals " + fixed(fit.rms, 2) + " times the noise",
                   fit.verdict != FitVerdict::ok});
  if (fit.verdict == FitVerdict::poor_fit) boxes.back().value = "poor fit";
  if (fit.verdict == FitVerdict::iteration_limit) boxes.back().value = "not converged";
  const FittedValue& depth = fit.at(PadParameter::depth);
  boxes.push_back({number(found, PadParameter::depth, depth.value, depth.sd),
                   "depth, stated as " + number(found, PadParameter::depth, depth.nominal),
                   depth.verdict != ValueVerdict::identified});
  if (const FittedValue& h = fit.at(PadParameter::thickness); found.material().layer)
    boxes.push_back({number(found, PadParameter::thickness, h.value, h.sd),
                     "thickness, stated as " + number(found, PadParameter::thickness, h.nominal),
                     h.verdict != ValueVerdict::identified});
  std::size_t known = 0;
  double squares = 0.0;
  double mean = 0.0;
  bool absolute = true;
  for (const FittedValue& one : fit.mean_gain)
    absolute = absolute && one.verdict != ValueVerdict::not_identifiable;
  for (std::size_t j = 0; j < fit.gain.size(); ++j) {
    known += fit.gain_about_mean[j] == ValueVerdict::identified ? 1U : 0U;
    mean += std::log(fit.gains[j]) / static_cast<double>(fit.gain.size());
  }
  for (const FittedValue& gain : fit.gain) squares += std::pow(std::log(gain.value) - mean, 2);
  boxes.push_back(
      {std::to_string(known) + " of " + std::to_string(fit.gain.size()),
       std::string(absolute ? "gains" : "gains about their mean") + " identified; they are " +
           percent(std::sqrt(squares / static_cast<double>(fit.gain.size()))) + " apart",
       known < fit.gain.size()});
  const std::size_t hidden = null_directions_in_words(found).size();
  boxes.push_back(
      {std::to_string(hidden),
       hidden == 1 ? "thing cannot be known from this log" : "things cannot be known from this log",
       false});
  return boxes;
}

void print_calibration(std::ostream& out, const lab::SceneCalibration& found) {
  print_cells(out, calibration_cells(found));
  out << '\n';
  for (const std::string& sentence : calibration_in_words(found)) out << sentence << '\n';
  for (const std::string& sentence : null_directions_in_words(found)) out << sentence << '\n';
  if (found.next.presses.empty()) return;
  out << '\n';
  print_cells(out, next_press_cells(found));
  out << next_presses_in_words(found) << '\n';
}

}  // namespace tactile_net::report
