#include "tactile_net/scene/calibrated_scene.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "scene/document.hpp"
#include "scene/edited_text.hpp"
#include "scene/sections.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net {
namespace {

/// As many digits as tell a thousandth of the standard deviation; every one where there is none.
std::string rounded(double value, double sd) {
  if (!(sd > 0.0) || !std::isfinite(sd) || value == 0.0) return shortest(value);
  const double step = std::pow(10.0, std::floor(std::log10(1e-3 * sd)));
  const double whole = std::round(value / step);
  if (std::abs(whole) > 9e15) return shortest(value);
  // Divided by a power of ten that is whole: the nearest double to the decimal number.
  return shortest(step < 1.0 ? whole / std::round(1.0 / step) : whole * step);
}

std::string list_of(const std::vector<double>& values, const std::vector<double>& sds) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (i == 0 ? "" : i % 8 == 0 ? ",\n  " : ", ") + rounded(values[i], sds[i]);
  return text + "]";
}

const std::optional<Units>& stated_units(const AnyScene& scene) {
  return std::visit([](const auto& one) -> const std::optional<Units>& { return one.units; },
                    scene);
}

std::string calibration_table(const AnyScene& scene, const PressLog& log, const PressFit& fit,
                              std::string_view from) {
  const SensorScale raw = sensor_scale(scene, fit);
  const std::optional<Units>& units = stated_units(scene);
  std::string text =
      "[calibration]  # number = gains * reading + offsets, by tactile-net calibrate\n";
  if (fit.verdict != FitVerdict::ok)
    text += "# " + std::string(tactile_net::name(fit.verdict)) + ": not to be trusted\n";
  text += "gains = " + list_of(raw.gains, raw.gain_sds) + '\n';
  text += "offsets = " + list_of(raw.offsets, raw.offset_sds) + '\n';
  if (const auto& own = std::visit(
          [](const auto& one) -> const std::optional<Calibration>& { return one.calibration; },
          scene);
      own && !own->missing.empty()) {
    std::string codes;
    for (const double code : own->missing) codes += (codes.empty() ? "" : ", ") + shortest(code);
    text += "missing = [" + codes + "]\n";
  }
  std::string name(from);
  std::erase_if(name,
                [](char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 32; });
  text += "from = \"" + name + "\"\n";
  text += "presses = " + std::to_string(log.presses.size()) + '\n';
  text += "chi_squared = " + brief(fit.chi_squared) + '\n';
  text += "dof = " + brief(fit.dof) + '\n';
  std::string sds;
  for (const PadParameter parameter : fit.free) {
    const FittedValue& value = fit.at(parameter);
    if (!is_found(value.verdict)) continue;
    const double unit =
        !units                                      ? 1.0
        : parameter == PadParameter::youngs_modulus ? units->modulus.from_si(1.0)
        : parameter == PadParameter::poisson_ratio || parameter == PadParameter::crosstalk
            ? 1.0
            : units->length.from_si(1.0);
    sds += (sds.empty() ? "" : ", ") + std::string(tactile_net::name(parameter)) + " = " +
           brief(value.sd * unit);
  }
  if (!sds.empty()) text += "sd = { " + sds + " }\n";
  return text;
}

/// Every line ended as Windows ends them, those that are added among lines that were, too.
std::string with_carriage_returns(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n' && (i == 0 || text[i - 1] != '\r')) result += '\r';
    result += text[i];
  }
  return result;
}

/// Noise of the corrected readings, one number or one for each quantity.
/// @param nominal  of either kind
std::string noise_of(const auto& nominal, const PressLog& log, const PressFit& fit) {
  const auto channel = channels(nominal.sensor);
  std::string text;
  for (const auto quantity : nominal.sensor.reads) {
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t c = 0; c < channel.size(); ++c)
      if (channel[c].quantity == quantity) {
        squares += std::pow(log.unloaded.rms[c] / fit.mean_gain[c].value, 2);
        count += 1.0;
      }
    const Unit unit = nominal.units ? unit_of(*nominal.units, traits(quantity).kind) : Unit{};
    const double number = unit.from_si(std::sqrt(squares / count));
    const std::string rms = rounded(number, 0.1 * number);
    if (nominal.sensor.reads.size() == 1) return rms;
    text += (text.empty() ? "{ " : ", ") + std::string(name(quantity)) + " = " + rms;
  }
  return text + " }";
}

/// Lengths that were found [m], with their standard deviations: a factor on those that were stated.
struct Lengths {
  bool found = false;
  std::vector<double> values{}, sds{};

  [[nodiscard]] std::string text(std::size_t i, const Unit& unit) const {
    return rounded(unit.from_si(values[i]), unit.from_si(sds[i]));
  }
  [[nodiscard]] std::string list(const Unit& unit) const {
    std::string text = "[";
    for (std::size_t i = 0; i < values.size(); ++i)
      text += (i == 0 ? "" : i % 8 == 0 ? ",\n  " : ", ") + this->text(i, unit);
    return text + "]";
  }
};

Lengths scaled(std::vector<double> lengths, const FittedValue& value, double log_factor) {
  Lengths result{.found = is_found(value.verdict), .values = std::move(lengths)};
  for (double& length : result.values) {
    if (result.found) length *= std::exp(log_factor);
    result.sds.push_back(result.found ? std::abs(length * value.sd / value.value) : 0.0);
  }
  return result;
}

/// Of an even array the depths at which it reads, of an uneven one those of its taxels.
Lengths found_depths(const auto& array, const PressFit& fit) {
  std::vector<double> depths = array.depths;
  if (!is_even(array)) {
    depths.clear();
    for (const auto& taxel : array.taxels) depths.push_back(taxel.depth);
  }
  return scaled(std::move(depths), fit.at(PadParameter::depth), fit.pad.log_depth);
}

/// y of the taxels. A pitch has its own standard deviation; its factor on every place is the same.
Lengths found_places(const SensorArray& array, const PressFit& fit) {
  return scaled(positions(array), fit.at(PadParameter::pitch), fit.pad.log_pitch);
}

/// Where the scene's text has them: one depth, a list of them.
void put_depths(const toml::table& sensor, const Lengths& depths, const Unit& unit,
                EditedText& edited) {
  const auto put_list = [&](const toml::array* list, const Lengths& lengths) {
    for (std::size_t i = 0; list != nullptr && lengths.found && i < list->size(); ++i)
      edited.replace(*list->get(i), lengths.text(i, unit));
  };
  const toml::node* depth = sensor.get("depth");
  if (depth != nullptr && depth->is_number() && depths.found)
    edited.replace(*depth, depths.text(0, unit));
  put_list(depth == nullptr ? nullptr : depth->as_array(), depths);
  put_list(sensor["depths"].as_array(), depths);
}

/// A list of places.
void put_places(const toml::table& sensor, const Lengths& places, const Unit& unit,
                EditedText& edited) {
  const toml::array* list = sensor["positions"].as_array();
  for (std::size_t i = 0; list != nullptr && places.found && i < list->size(); ++i)
    edited.replace(*list->get(i), places.text(i, unit));
}

std::string quoted(const std::vector<Quantity>& quantities) {
  std::string text = "[";
  for (const Quantity quantity : quantities)
    text += (text.size() > 1 ? ", \"" : "\"") + std::string(name(quantity)) + '"';
  return text + "]";
}

/// Taxels of a file stand in the scene itself once their depths are others: the file stays as it
/// is.
void put_taxels(const toml::table& sensor, const SensorArray& array, const Lengths& depths,
                const Lengths& places, const Unit& unit, EditedText& edited) {
  if (!depths.found && !places.found) return;
  Lengths widths{.found = true};
  bool alike = true;
  std::string reads = "[";
  for (std::size_t i = 0; const Taxel& taxel : array.taxels) {
    widths.values.push_back(taxel.width);
    widths.sds.push_back(0.0);
    alike = alike && taxel.reads == array.taxels.front().reads;
    reads += (i == 0 ? "" : i % 4 == 0 ? ",\n  " : ", ") + quoted(taxel.reads);
    ++i;
  }
  std::string text = "positions = " + places.list(unit);
  const auto put = [&](std::string_view key, const std::string& value) {
    if (const toml::node* stated = sensor.get(key))
      edited.replace(*stated, value);
    else
      text += '\n' + std::string(key) + " = " + value;
  };
  put("depth", depths.list(unit));
  if (std::any_of(widths.values.begin(), widths.values.end(), [](double w) { return w > 0.0; }))
    put("width", widths.list(unit));
  put("reads", alike ? quoted(array.taxels.front().reads) : reads + "]");
  for (const auto& [key, node] : sensor)
    if (key == "taxels") edited.replace_line_part(key.source().begin, node.source().end, text);
}

SensorScale scale_of(const auto& nominal, const PressFit& fit) {
  SensorScale raw;
  const auto where = sites(nominal.sensor);
  for (std::size_t i = 0; i < fit.gains.size(); ++i) {
    const double to_si =
        nominal.units ? unit_of(*nominal.units, traits(where[i].quantity).kind).to_si(1.0) : 1.0;
    const double gain = nominal.calibration ? nominal.calibration->gain[i] : 1.0;
    const double own = nominal.calibration ? nominal.calibration->offset[i] : 0.0;
    const double baseline = nominal.calibration ? nominal.calibration->baseline[i] : 0.0;
    raw.gains.push_back(fit.gains[i] / gain * to_si);
    raw.gain_sds.push_back(fit.gain[i].sd / std::abs(gain) * to_si);
    raw.offsets.push_back((fit.offsets[i] - own) / gain + baseline);
    raw.offset_sds.push_back(fit.offset[i].sd / std::abs(gain));
  }
  return raw;
}

/// The sensor of a line.
void put_sensor(const toml::table& sensor, const Scene& nominal, const PressFit& fit,
                const Units& units, EditedText& edited) {
  const Lengths depths = found_depths(nominal.sensor, fit);
  const Lengths places = found_places(nominal.sensor, fit);
  if (sensor.contains("taxels"))
    return put_taxels(sensor, nominal.sensor, depths, places, units.length, edited);
  put_depths(sensor, depths, units.length, edited);
  if (!is_even(nominal.sensor)) put_places(sensor, places, units.length, edited);
}

/// Of a skin: two pitches by one factor; taxels of a file get a factor on their depths.
void put_sensor(const toml::table& sensor, const SkinScene& nominal, const PressFit& fit,
                const Units& units, EditedText& edited) {
  const FittedValue& depth = fit.at(PadParameter::depth);
  if (is_even(nominal.sensor)) {
    put_depths(sensor, found_depths(nominal.sensor, fit), units.length, edited);
    const FittedValue& pitch = fit.at(PadParameter::pitch);
    const toml::array* both = sensor["pitch"].as_array();
    const Lengths pitches =
        scaled({nominal.sensor.pitch_y, nominal.sensor.pitch_z}, pitch, fit.pad.log_pitch);
    for (std::size_t i = 0; both != nullptr && pitches.found && i < both->size(); ++i)
      edited.replace(*both->get(i), pitches.text(i, units.length));
    return;
  }
  if (!is_found(depth.verdict)) return;
  const double before = sensor["depth_factor"].value_or(1.0);
  const double factor = before * std::exp(fit.pad.log_depth);
  const std::string text = rounded(factor, factor * depth.sd / depth.value);
  if (const toml::node* stated = sensor.get("depth_factor")) return edited.replace(*stated, text);
  const toml::source_region& taxels = sensor.get("taxels")->source();
  edited.insert_line_before(taxels.begin, "depth_factor = " + text + "  # on the file's depths\n");
}

}  // namespace

SensorScale sensor_scale(const AnyScene& nominal, const PressFit& fit) {
  return std::visit([&](const auto& one) { return scale_of(one, fit); }, nominal);
}

bool is_found(ValueVerdict verdict) noexcept {
  return verdict == ValueVerdict::identified || verdict == ValueVerdict::weak ||
         verdict == ValueVerdict::at_bound;
}

std::string calibrated_scene(std::string_view toml, const AnyScene& nominal, const PressLog& log,
                             const PressFit& fit, std::string_view from) {
  const std::string_view text = without_byte_order_mark(toml);
  const std::string file = std::visit([](const auto& one) { return one.file; }, nominal);
  Problems problems(file, text);
  const toml::table root = parse_document(text, file, problems);
  EditedText edited(text);
  const auto put = [&](const toml::node* node, PadParameter parameter, const Unit& unit) {
    const FittedValue& value = fit.at(parameter);
    if (node != nullptr && is_found(value.verdict))
      edited.replace(*node, rounded(unit.from_si(value.value), unit.from_si(value.sd)));
  };
  const Units units = stated_units(nominal).value_or(Units{});
  if (const toml::table* sensor = root["sensor"].as_table(); sensor != nullptr)
    std::visit([&](const auto& one) { put_sensor(*sensor, one, fit, units, edited); }, nominal);
  if (const toml::node* pitch = root.at_path("sensor.pitch").node();
      pitch != nullptr && pitch->is_number())
    put(pitch, PadParameter::pitch, units.length);
  put(root.at_path("material.youngs_modulus").node(), PadParameter::youngs_modulus, units.modulus);
  put(root.at_path("material.poisson_ratio").node(), PadParameter::poisson_ratio, {});
  put(root.at_path("material.layer.thickness").node(), PadParameter::thickness, units.length);
  put(root.at_path("crosstalk.fraction").node(), PadParameter::crosstalk, {});
  std::string tail;
  const std::string noise =
      std::visit([&](const auto& one) { return noise_of(one, log, fit); }, nominal);
  if (const toml::node* rms = root.at_path("noise.rms").node())
    edited.replace(*rms, noise);
  else if (!root.contains("noise"))
    tail += "\n[noise]  # measured without load\nrms = " + noise + '\n';
  if (const toml::table* own = root.at_path("calibration").as_table()) edited.remove(*own);
  std::string result = std::move(edited).text();
  if (!result.empty() && result.back() != '\n') result += '\n';
  result += tail + '\n' + calibration_table(nominal, log, fit, from);
  if (text.find("\r\n") != std::string_view::npos) result = with_carriage_returns(result);
  // What is written can be read; a skin's file of taxels is not beside a text without a folder.
  const auto* skin = std::get_if<SkinScene>(&nominal);
  if (skin == nullptr || is_even(skin->sensor)) static_cast<void>(parse_any_scene(result, file));
  return result;
}

}  // namespace tactile_net
