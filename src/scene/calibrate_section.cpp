#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"

namespace tactile_net {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct DeviationKey {
  std::string_view name;
  double CalibrationOptions::*member;
};
constexpr std::array deviation_keys = {
    DeviationKey{"gain_sd", &CalibrationOptions::gain_sd},
    DeviationKey{"mean_gain_sd", &CalibrationOptions::mean_gain_sd},
    DeviationKey{"half_width_sd", &CalibrationOptions::half_width_sd}};

constexpr std::array sharings = {GainSharing::reading, GainSharing::taxel, GainSharing::channel};

/// A number, or the text "unknown".
double sd_of(const Value& value, const Unit& unit, double otherwise) {
  if (value.is_text()) {
    if (value.text() == "unknown") return infinity;
    value.misfit("must be a standard deviation, or \"unknown\"", "0 is exact");
    return otherwise;
  }
  return value.number(not_negative, unit).value_or(otherwise);
}

}  // namespace

CalibrationOptions read_calibrate(Table table, const Units& units, bool has_layer, bool of_skin) {
  CalibrationOptions options;
  std::array<std::string, pad_parameter_count> names;
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const auto parameter = static_cast<PadParameter>(i);
    if (parameter == PadParameter::shift_z) continue;  // shift_sd is for both
    names[i] = std::string(name(parameter)) + "_sd";
    const Unit unit = parameter == PadParameter::shift ? units.length : Unit{};
    if (const auto value = table.value(names[i]))
      options.set_sd(parameter, sd_of(*value, unit, options.sd(parameter)));
  }
  if (of_skin) options.shift_z_sd = options.shift_sd;
  for (const DeviationKey& key : deviation_keys)
    if (const auto value = table.value(key.name))
      options.*key.member = sd_of(*value, {}, options.*key.member);
  if (const auto value = table.value("gains")) {
    std::vector<std::string_view> known;
    for (const GainSharing sharing : sharings) known.push_back(name(sharing));
    if (const auto which = value->one_of("sharing", known)) options.gains = sharings[*which];
  }
  if (const auto value = table.value("at_base")) {
    options.at_base = value->boolean().value_or(false);
    if (options.at_base && !has_layer)
      value->problem("puts the taxels at the base of a layer, and the material has no layer",
                     "layer = { thickness = 3.0, base = \"bonded\" } under [material]");
  }
  if (const auto value = table.value("fixed"))
    if (const auto list = value->list("names"))
      for (const Value& item : *list) {
        std::vector<std::string_view> known;
        for (std::size_t i = 0; i < pad_parameter_count; ++i)
          if (of_skin || static_cast<PadParameter>(i) != PadParameter::shift_z)
            known.push_back(name(static_cast<PadParameter>(i)));
        if (const auto which = item.one_of("parameter", known))
          options.set_sd(static_cast<PadParameter>(*which), 0.0);
      }
  table.finish();
  return options;
}

CalibrationOptions parse_calibration_options(std::string_view toml, const std::string& file) {
  const std::string_view text = without_byte_order_mark(toml);
  Problems problems(file, text);
  const toml::table document = parse_document(text, file, problems);
  Table root(document, "", problems);
  const auto calibrate = root.value("calibrate");
  CalibrationOptions options;
  if (calibrate) {
    Units units;
    const bool skin = is_skin(document, std::filesystem::path(file).parent_path());
    if (const auto table = table_of(root.value("units")))
      units = read_units(*table, skin ? Dimension::point_force : Dimension::force);
    if (const auto table = table_of(calibrate))
      options =
          read_calibrate(*table, units, document.at_path("material.layer").node() != nullptr, skin);
  }
  problems.throw_if_any();
  return options;
}

}  // namespace tactile_net
