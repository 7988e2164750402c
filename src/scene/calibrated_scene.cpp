#include "tactile_net/scene/calibrated_scene.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net {
namespace {

/// The text's lines, whose parts are replaced from the end to the beginning.
class EditedText {
 public:
  explicit EditedText(std::string_view text) : text_(text) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') starts_.push_back(i + 1);
  }

  /// Where a position of the parser is; columns count code points, from 1.
  [[nodiscard]] std::size_t at(const toml::source_position& position) const {
    std::size_t offset = starts_.at(position.line - 1);
    for (std::size_t column = 1; column < position.column; ++column) {
      ++offset;
      while (offset < text_.size() && (static_cast<unsigned char>(text_[offset]) & 0xC0) == 0x80)
        ++offset;
    }
    return offset;
  }
  void replace(std::size_t from, std::size_t to, std::string with) {
    edits_.push_back({from, to, std::move(with)});
  }
  void replace(const toml::node& node, std::string with) {
    replace(at(node.source().begin), at(node.source().end), std::move(with));
  }
  /// A key with its value, which begins its line.
  /// @throw std::invalid_argument  it does not
  void replace_line_part(const toml::source_position& from, const toml::source_position& to,
                         std::string with) {
    const std::size_t begin = at(from);
    if (text_.find_first_not_of(" \t", starts_.at(from.line - 1)) != begin)
      throw std::invalid_argument(
          "calibrate writes sensor.taxels anew: let it begin a line of a table [sensor]");
    replace(begin, at(to), std::move(with));
  }
  /// A table from its header up to its last line that says something.
  void remove(const toml::table& table) {
    const std::size_t from = starts_.at(table.source().begin.line - 1);
    std::size_t line = table.source().begin.line;
    std::size_t to = line < starts_.size() ? starts_[line] : text_.size();
    for (; line < starts_.size(); ++line) {
      const std::string_view content = line_of(line);
      const std::size_t first = content.find_first_not_of(" \t\r\n");
      if (first != std::string_view::npos && content[first] == '[' && !inside_value(from, line))
        break;
      if (first != std::string_view::npos && content[first] != '#')
        to = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
    }
    replace(from, to, "");
  }
  [[nodiscard]] std::string text() && {
    std::sort(edits_.begin(), edits_.end(),
              [](const Edit& a, const Edit& b) { return a.from > b.from; });
    for (const Edit& edit : edits_) text_.replace(edit.from, edit.to - edit.from, edit.with);
    return std::move(text_);
  }

 private:
  struct Edit {
    std::size_t from, to;
    std::string with;
  };
  [[nodiscard]] std::string_view line_of(std::size_t line) const {
    const std::size_t end = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
    return std::string_view(text_).substr(starts_[line], end - starts_[line]);
  }
  /// The line goes on with a list that an earlier one began.
  [[nodiscard]] bool inside_value(std::size_t from, std::size_t line) const {
    long depth = 0;
    bool in_comment = false;
    for (std::size_t i = from; i < starts_[line]; ++i) {
      if (text_[i] == '\n') in_comment = false;
      if (text_[i] == '#') in_comment = true;
      if (in_comment) continue;
      if (text_[i] == '[') ++depth;
      if (text_[i] == ']') --depth;
    }
    return depth > 0;
  }

  std::string text_;
  std::vector<std::size_t> starts_{};
  std::vector<Edit> edits_{};
};

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

std::string calibration_table(const Scene& nominal, const PressLog& log, const PressFit& fit,
                              std::string_view from) {
  const SensorScale raw = sensor_scale(nominal, fit);
  std::string text =
      "[calibration]  # number = gains * reading + offsets, by tactile-net calibrate\n";
  if (fit.verdict != FitVerdict::ok)
    text += "# " + std::string(tactile_net::name(fit.verdict)) + ": not to be trusted\n";
  text += "gains = " + list_of(raw.gains, raw.gain_sds) + '\n';
  text += "offsets = " + list_of(raw.offsets, raw.offset_sds) + '\n';
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
        !nominal.units                              ? 1.0
        : parameter == PadParameter::youngs_modulus ? nominal.units->modulus.from_si(1.0)
        : parameter == PadParameter::poisson_ratio || parameter == PadParameter::crosstalk
            ? 1.0
            : nominal.units->length.from_si(1.0);
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
std::string noise_of(const Scene& nominal, const PressLog& log, const PressFit& fit) {
  const std::vector<Channel> channel = channels(nominal.sensor);
  std::string text;
  for (const Quantity quantity : nominal.sensor.reads) {
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t c = 0; c < channel.size(); ++c)
      if (channel[c].quantity == quantity) {
        squares += std::pow(log.unloaded.rms[c] / fit.mean_gain[c].value, 2);
        count += 1.0;
      }
    const Unit unit =
        nominal.units ? unit_of(*nominal.units, traits(SignalQuantity(quantity)).kind) : Unit{};
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
Lengths found_depths(const SensorArray& array, const PressFit& fit) {
  std::vector<double> depths = array.depths;
  if (!is_even(array)) {
    depths.clear();
    for (const Taxel& taxel : array.taxels) depths.push_back(taxel.depth);
  }
  return scaled(std::move(depths), fit.at(PadParameter::depth), fit.pad.log_depth);
}

/// y of the taxels. A pitch has its own standard deviation; its factor on every place is the same.
Lengths found_places(const SensorArray& array, const PressFit& fit) {
  return scaled(positions(array), fit.at(PadParameter::pitch), fit.pad.log_pitch);
}

/// Where the scene's text has them: one depth, a list of them, a list of places.
void put_lengths(const toml::table& sensor, const SensorArray& array, const Lengths& depths,
                 const Lengths& places, const Unit& unit, EditedText& edited) {
  const auto put_list = [&](const toml::array* list, const Lengths& lengths) {
    for (std::size_t i = 0; list != nullptr && lengths.found && i < list->size(); ++i)
      edited.replace(*list->get(i), lengths.text(i, unit));
  };
  const toml::node* depth = sensor.get("depth");
  if (depth != nullptr && depth->is_number() && depths.found)
    edited.replace(*depth, depths.text(0, unit));
  put_list(depth == nullptr ? nullptr : depth->as_array(), depths);
  put_list(sensor["depths"].as_array(), depths);
  if (!is_even(array)) put_list(sensor["positions"].as_array(), places);
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

}  // namespace

SensorScale sensor_scale(const Scene& nominal, const PressFit& fit) {
  SensorScale raw;
  const std::vector<Site> where = sites(nominal.sensor);
  for (std::size_t i = 0; i < fit.gains.size(); ++i) {
    const double to_si =
        nominal.units
            ? unit_of(*nominal.units, traits(SignalQuantity(where[i].quantity)).kind).to_si(1.0)
            : 1.0;
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

bool is_found(ValueVerdict verdict) noexcept {
  return verdict == ValueVerdict::identified || verdict == ValueVerdict::weak ||
         verdict == ValueVerdict::at_bound;
}

std::string calibrated_scene(std::string_view toml, const Scene& nominal, const PressLog& log,
                             const PressFit& fit, std::string_view from) {
  const std::string_view text = without_byte_order_mark(toml);
  Problems problems(nominal.file, text);
  const toml::table root = parse_document(text, nominal.file, problems);
  problems.throw_if_any();
  EditedText edited(text);
  const auto put = [&](const toml::node* node, PadParameter parameter, const Unit& unit) {
    const FittedValue& value = fit.at(parameter);
    if (node != nullptr && is_found(value.verdict))
      edited.replace(*node, rounded(unit.from_si(value.value), unit.from_si(value.sd)));
  };
  const Units units = nominal.units.value_or(Units{});
  if (const toml::table* sensor = root["sensor"].as_table(); sensor != nullptr) {
    const Lengths depths = found_depths(nominal.sensor, fit);
    if (root.at_path("sensor.taxels"))
      put_taxels(*sensor, nominal.sensor, depths, found_places(nominal.sensor, fit), units.length,
                 edited);
    else
      put_lengths(*sensor, nominal.sensor, depths, found_places(nominal.sensor, fit), units.length,
                  edited);
  }
  put(root.at_path("sensor.pitch").node(), PadParameter::pitch, units.length);
  put(root.at_path("material.youngs_modulus").node(), PadParameter::youngs_modulus, units.modulus);
  put(root.at_path("material.poisson_ratio").node(), PadParameter::poisson_ratio, {});
  put(root.at_path("material.layer.thickness").node(), PadParameter::thickness, units.length);
  put(root.at_path("crosstalk.fraction").node(), PadParameter::crosstalk, {});
  std::string tail;
  const std::string noise = noise_of(nominal, log, fit);
  if (const toml::node* rms = root.at_path("noise.rms").node())
    edited.replace(*rms, noise);
  else if (!root.contains("noise"))
    tail += "\n[noise]  # measured without load\nrms = " + noise + '\n';
  if (const toml::table* own = root.at_path("calibration").as_table()) edited.remove(*own);
  std::string result = std::move(edited).text();
  if (!result.empty() && result.back() != '\n') result += '\n';
  result += tail + '\n' + calibration_table(nominal, log, fit, from);
  if (text.find("\r\n") != std::string_view::npos) result = with_carriage_returns(result);
  static_cast<void>(parse_scene(result, nominal.file));  // what is written can be read
  return result;
}

}  // namespace tactile_net
