#include "tactile_net/frames/press_log_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "frames/converter_steps.hpp"
#include "frames/log_sensor.hpp"
#include "frames/rest_deviations.hpp"
#include "scene/csv_table.hpp"
#include "scene/degrees.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

constexpr std::size_t most_problems = 20;
constexpr double contradiction = 5.0;  // standard deviations
constexpr double measured_off = 3.0;   // standard deviations of a place
constexpr double most_at_rest = 4.0;   // rms of an unloaded row about the others, over the noise

struct Rule {
  std::string_view text;
  bool (*holds)(double);
};
constexpr Rule any_number{"", [](double) { return true; }};
constexpr Rule positive{"must be > 0", [](double x) { return x > 0.0; }};
constexpr Rule not_negative{"must be >= 0", [](double x) { return x >= 0.0; }};

class Reader {
 public:
  Reader(const std::filesystem::path& path, const AnyScene& scene,
         const CalibrationOptions& options)
      : file_(path.filename().string()), sensor_(scene), options_(options) {
    try {
      table_ = read_csv_table(path);
    } catch (const std::runtime_error& error) {
      throw InputError({{.file = path.string(), .message = error.what()}});
    }
  }

  PressLogFile read() {
    find_columns();
    throw_if_any();
    for (const CsvTable::Row& row : table_.rows) take(row);
    throw_if_any();
    check_whole();
    throw_if_any();
    check_rest();
    throw_if_any();
    result_.log.unloaded = unloaded_frames(sensor_.layout, unloaded_);
    find_steps();
    check_readings();
    throw_if_any();
    remark();
    return std::move(result_);
  }

 private:
  void problem(std::size_t line, std::string message, std::string hint) {
    if (problems_.size() < most_problems)
      problems_.push_back(
          {.file = file_, .line = line, .message = std::move(message), .hint = std::move(hint)});
  }
  void throw_if_any() {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }

  void find_columns() {
    const std::vector<std::string>& header = table_.header.fields;
    for (std::size_t i = 0; i < header.size(); ++i)
      if (!columns_.emplace(header[i], i).second)
        problem(table_.header.line, "a column stands there twice", "keep one of the two");
    sensor_.by_place = sensor_.curved && columns_.contains(place_columns.front());
    if (sensor_.by_place && (columns_.contains("position_y") || columns_.contains("position_z")))
      problem(table_.header.line,
              "has places in the sensor's axes, place_x, and positions on the chart, position_y",
              "keep one of the two");
    for (const std::string& name : sensor_.described())
      if (!columns_.contains(name))
        problem(table_.header.line, "has no column '" + name + "'",
                "the header begins with " + sensor_.header() + "; what is not known is left empty");
    std::vector<std::string> missing;
    for (const std::string& name : sensor_.readings) {
      if (const auto found = columns_.find(name); found != columns_.end())
        readings_.push_back(found->second);
      else
        missing.push_back(name);
    }
    if (!missing.empty()) {
      const std::size_t others = missing.size() - 1;
      const std::string nor = others > 0 ? " nor " + std::to_string(others) + " others" : "";
      problem(table_.header.line,
              "has no column '" + missing.front() + "'" + nor + " of the scene's " +
                  std::to_string(sensor_.readings.size()) + " readings",
              std::string("a log of another scene? ") +
                  (sensor_.is_skin ? "[sensor] says" : "sensor.count and sensor.reads say") +
                  " which columns there are");
    }
    if (!sensor_.is_skin) check_other_taxels();
    std::set<std::string> known;
    for (const auto& names : {sensor_.described(), sensor_.optional_columns()})
      known.insert(names.begin(), names.end());
    for (const std::string& name : sensor_.readings) known.insert(name);
    const auto others = std::count_if(header.begin(), header.end(),
                                      [&](const auto& name) { return !known.contains(name); });
    if (others > 0)
      result_.notes.push_back(std::to_string(others) +
                              (others == 1 ? " column is not read" : " columns are not read"));
  }

  /// "stress_x_41" in a log of a scene with 41 taxels: fewer than the sensor has.
  void check_other_taxels() {
    const std::size_t count = sensor_.layout.taxels;
    for (std::size_t c = 0; c < sensor_.channels.size(); ++c) {
      const std::string own = sensor_.channels[c] + '_';
      std::size_t others = 0;
      for (const auto& [name, column] : columns_) {
        double taxel = 0.0;
        if (name.size() > own.size() && name.compare(0, own.size(), own) == 0 &&
            read_number(name.substr(own.size()), taxel) && taxel >= static_cast<double>(count))
          ++others;
      }
      if (others > 0)
        problem(table_.header.line,
                "has " + std::to_string(sensor_.layout.channels[c].count + others) + " columns " +
                    own + "0, ..., and the scene has " + std::to_string(count) + " taxels",
                "a log of another scene? sensor.count says how many there are");
    }
  }

  std::optional<double> number(const CsvTable::Row& row, const std::string& name, const Rule& rule,
                               const Unit& unit = {}) {
    const auto column = columns_.find(name);
    if (column == columns_.end() || row.fields[column->second].empty()) return std::nullopt;
    double value = 0.0;
    if (!read_number(row.fields[column->second], value) || !std::isfinite(value)) {
      problem(row.line, name + " is not a finite number", "leave it empty if it is not known");
      return std::nullopt;
    }
    if (!rule.holds(value)) {
      problem(row.line, name + ' ' + std::string(rule.text) + " (got " + shortest(value) + ')',
              name == "force" ? "compression is positive; a row without load has press 0"
                              : "leave it empty if it is not known");
      return std::nullopt;
    }
    return unit.to_si(value);
  }

  Stated stated(const CsvTable::Row& row, const std::string& name, const Rule& rule,
                const Unit& unit) {
    Stated result{number(row, name, rule, unit), 0.0};
    result.sd = number(row, name + "_sd", not_negative, unit).value_or(0.0);
    const auto column = columns_.find(name);
    if (result.sd > 0.0 && (column == columns_.end() || row.fields[column->second].empty()))
      problem(row.line, name + "_sd is given without " + name, "give both, or neither");
    return result;
  }

  std::vector<double> readings(const CsvTable::Row& row) {
    std::vector<double> values;
    for (const std::size_t column : readings_) {
      double value = 0.0;
      const bool is_number = read_number(row.fields[column], value) && std::isfinite(value);
      if (!is_number || (sensor_.calibration && is_missing(*sensor_.calibration, value))) {
        problem(row.line,
                table_.header.fields[column] +
                    (is_number ? " is a code of calibration.missing" : " is not a finite number"),
                "every reading is needed; dead ones stand in [dead_taxels], and here as 0");
        return {};
      }
      values.push_back(value);
    }
    if (sensor_.calibration) calibrate(*sensor_.calibration, values);
    return values;
  }

  void take(const CsvTable::Row& row) {
    const std::string& shape = row.fields[columns_.at("shape")];
    double count = 0.0;
    if (!read_number(row.fields[columns_.at("press")], count) || count < 0.0 ||
        count != std::floor(count) || count > 1e9) {
      problem(row.line, "press is not a whole number from 0 up",
              "0: unloaded; presses count from 1");
      return;
    }
    if (count == 0.0 || shape == "none") {
      if (!shape.empty() && shape != "none")
        problem(row.line, "press 0 is a row without load, and its shape is none",
                "shape none, or the press' own number, from 1");
      if (number(row, "force", any_number).value_or(0.0) != 0.0)
        problem(row.line, "is a row without load, and has a force",
                "leave force empty, or give the press its number and its shape");
      unloaded_.push_back(readings(row));
      unloaded_lines_.push_back(row.line);
      return;
    }
    Press press{.number = static_cast<std::size_t>(count)};
    if (!numbers_.insert(press.number).second)
      problem(row.line, "press " + std::to_string(press.number) + " stands there twice",
              "a row a press: the mean of its steady frames");
    if (!sensor_.set_shape(shape, press))
      problem(row.line, "shape '" + shape + "' is not known", std::string(sensor_.shapes()));
    press.force = stated(row, "force", positive, sensor_.force);
    read_place(row, press);
    press.half_width = stated(row, "half_width", positive, sensor_.units.length);
    press.radius = number(row, "radius", positive, sensor_.units.length);
    read_friction(row, press);
    if (press.radius && !sensor_.is_round(press))
      problem(row.line,
              "radius is of a " + std::string(sensor_.round_shape()) + ", and the shape is none",
              sensor_.is_skin ? "a punch and a cone have a half_width, their contact's radius"
                              : "a punch and a wedge have a half_width");
    check_place(row, press);
    check_tie(row, press);
    press.readings = readings(row);
    result_.log.presses.push_back(std::move(press));
  }

  void read_place(const CsvTable::Row& row, Press& press) {
    const Unit& length = sensor_.units.length;
    if (!sensor_.is_skin) {
      press.position = stated(row, "position", any_number, length);
      return;
    }
    const double sd = number(row, "position_sd", not_negative, length).value_or(0.0);
    if (sensor_.by_place) return read_place_in_space(row, sd, press);
    press.position = {number(row, "position_y", any_number, length), sd};
    press.position_z = {number(row, "position_z", any_number, length), sd};
    if (sd > 0.0 && !press.position.value && !press.position_z.value)
      problem(row.line, "position_sd is given without a position", "give both, or neither");
  }

  /// In the sensor's axes: the nearest place of the surface counts, on its chart.
  void read_place_in_space(const CsvTable::Row& row, double sd, Press& press) {
    press.position = press.position_z = {std::nullopt, sd};
    SpaceVector point{};
    std::size_t given = 0;
    for (std::size_t k = 0; k < point.size(); ++k)
      if (const auto value = number(row, place_columns[k], any_number, sensor_.units.length)) {
        point[k] = *value;
        ++given;
      }
    if (given == 0) {
      if (sd > 0.0)
        problem(row.line, "position_sd is given without a place", "give both, or neither");
      return;
    }
    if (given < point.size()) {
      problem(row.line, "a place has three numbers: place_x, place_y and place_z",
              "give all, or none");
      return;
    }
    const CurvedSurface::Charted at = sensor_.curved->surface.chart(point);
    if (std::abs(at.outside) > sensor_.depth + measured_off * sd) {
      problem(
          row.line, "the place lies " + brief(at.outside) + " m outside of the skin's surface",
          "where the indenter touches the skin, in the axes of the taxels' places; lengths in " +
              std::string(sensor_.units.length.name) + '?');
      return;
    }
    press.position.value = at.y;
    press.position_z.value = at.z;
  }

  /// On a skin with the direction of the drag; one sd for both of its parts.
  void read_friction(const CsvTable::Row& row, Press& press) {
    const Stated friction =
        stated(row, "friction", sensor_.is_skin ? not_negative : any_number, {});
    const std::optional<double> direction =
        sensor_.is_skin ? number(row, "direction", any_number, angle_degrees) : std::nullopt;
    if (direction && !friction.value)
      problem(row.line, "direction is given without friction", "give both, or neither");
    if (!friction.value) return;
    press.friction = friction;
    if (!sensor_.is_skin) return;
    if (*friction.value != 0.0 && !direction) {
      problem(row.line, "friction is given without its direction",
              "add a column direction: of the drag, from y towards z, in degrees; or give friction "
              "0 with friction_sd if neither is known");
      return;
    }
    const double angle = direction.value_or(0.0);
    press.friction = {*friction.value * std::cos(angle), friction.sd};
    press.friction_z = {*friction.value * std::sin(angle), friction.sd};
  }

  void check_place(const CsvTable::Row& row, const Press& press) {
    const std::string unit = std::string(sensor_.units.length.name) + '?';
    const double stated_width = press.half_width.value.value_or(0.0);
    const double across = std::max(sensor_.y.high - sensor_.y.low, sensor_.z.high - sensor_.z.low);
    if (2.0 * stated_width > across && across > 0.0) {
      problem(row.line, "half_width makes a contact wider than the array", "lengths in " + unit);
      return;
    }
    const double width = press.half_width.value ? stated_width : sensor_.depth;
    const auto check = [&](const Stated& stated, const LogSensor::End& ends, const char* name) {
      // Rods at the ends are asked for: what is not known of one is not held against it.
      const double a = width + measured_off * stated.sd;
      if (!stated.value || (*stated.value <= ends.high + a && *stated.value >= ends.low - a))
        return;
      if (ends.low == -ends.high)
        problem(row.line,
                name + (" lies beyond the array, which ends at +-" + brief(ends.high)) + " m",
                "0 is the middle of the array; lengths in " + unit);
      else
        problem(row.line,
                name + (" lies beyond the taxels, which end at " + brief(ends.low)) + " and " +
                    brief(ends.high) + " m",
                "positions are the taxels' own; lengths in " + unit);
    };
    check(press.position, sensor_.y,
          sensor_.by_place  ? "the place, along the chart's y,"
          : sensor_.is_skin ? "position_y"
                            : "position");
    if (sensor_.is_skin)
      check(press.position_z, sensor_.z,
            sensor_.by_place ? "the place, along the chart's z," : "position_z");
  }

  void check_tie(const CsvTable::Row& row, const Press& press) {
    if (!press.radius || !press.half_width.is_exact() || !press.force.value) return;
    const double tied = sensor_.half_width(press);
    const double sd = std::hypot(options_.half_width_sd, 0.5 * options_.youngs_modulus_sd, 0.1);
    if (std::abs(std::log(*press.half_width.value / tied)) > contradiction * sd)
      problem(row.line,
              "half_width and radius contradict each other: this " +
                  std::string(sensor_.is_skin ? "ball" : "rod") + "'s contact is about " +
                  brief(tied) + " m to each side",
              "leave one of them empty, or give half_width_sd");
  }

  void check_whole() {
    const std::size_t unloaded = unloaded_.size();
    if (unloaded < least_unloaded)
      problem(0,
              unloaded == 0 ? "has no unloaded row"
                            : "has only " + std::to_string(unloaded) + " unloaded rows",
              "at least 20 rows with press 0 and shape none: noise and offsets come from them");
    if (result_.log.presses.empty())
      problem(0, "has no press", "a row with press 1, its shape, and what is known of it");
  }

  void check_rest() {
    const std::vector<double> apart = rest_deviations(unloaded_, sensor_.dead);
    for (std::size_t row = 0; row < apart.size(); ++row)
      if (apart[row] > most_at_rest)
        problem(unloaded_lines_[row],
                "is not a row without load: its readings are " + brief(apart[row]) +
                    " times the noise away from those of the others",
                "offsets come from these rows; take it out, or say what pressed");
  }

  /// What a converter's steps leave of a number, in every reading: 0 where there are none.
  void find_steps() {
    const std::vector<Site>& where = sensor_.layout.readings;
    std::vector<double> of_channel(result_.log.unloaded.rms.size());
    for (std::size_t j = 0; j < readings_.size(); ++j) {
      std::set<double> values;
      for (const std::vector<double>& row : unloaded_) values.insert(row[j]);
      for (const Press& press : result_.log.presses) values.insert(press.readings[j]);
      steps_.push_back(converter_step(values));
      if (!sensor_.dead[j])
        of_channel[where[j].channel] = std::max(of_channel[where[j].channel], steps_[j]);
    }
    for (std::size_t c = 0; c < of_channel.size(); ++c)
      if (const double rms = of_channel[c] / std::sqrt(12.0); rms > result_.log.unloaded.rms[c]) {
        result_.log.unloaded.rms[c] = rms;
        result_.notes.push_back(sensor_.channels[c] + " has steps of " + brief(of_channel[c]) +
                                ", wider than its noise: " + brief(rms) +
                                " is taken for the noise: a step over the square root of 12");
      }
  }

  /// Readings that never change, and those that end where their range does.
  void check_readings() {
    const UnloadedFrames& rest = result_.log.unloaded;
    for (std::size_t j = 0; j < sensor_.readings.size(); ++j) {
      if (sensor_.dead[j]) continue;
      const std::string& name = sensor_.readings[j];
      std::vector<double> values;
      for (const Press& press : result_.log.presses) values.push_back(press.readings[j]);
      const bool moves = std::any_of(values.begin(), values.end(),
                                     [&](double value) { return value != rest.mean[j]; });
      if (rest.reading_rms[j] == 0.0 && !moves)
        problem(0, name + " never changes: a dead taxel",
                "[dead_taxels] indices = [" + std::to_string(sensor_.layout.readings[j].taxel) +
                    "], or write readings with more digits");
      if (const std::size_t count =
              times_at_end(values, rest.mean[j], 20.0 * rest.reading_rms[j], steps_[j]))
        problem(0,
                name + " has the same largest value in " + std::to_string(count) +
                    " presses: it is cut off at the end of its range",
                "press less hard, or leave these presses out");
    }
  }

  void remark() {
    if (sensor_.has_contacts)
      result_.notes.emplace_back("the scene's own contacts are ignored: the log says what pressed");
    const std::size_t rows = result_.log.presses.size() * readings_.size();
    const std::size_t unknowns = 2 * readings_.size() + 4 + 3 * result_.log.presses.size();
    if (rows < unknowns)
      result_.notes.push_back("fewer readings (" + std::to_string(rows) +
                              ") than unknowns (up to " + std::to_string(unknowns) +
                              "): the rest stays as the scene states it; press more often");
    const UnloadedFrames& frames = result_.log.unloaded;
    const double limit =
        4.0 / std::sqrt(static_cast<double>(frames.frames) * static_cast<double>(readings_.size()));
    if (std::abs(frames.neighbour_correlation) > limit)
      result_.notes.push_back("the noise of neighbours is correlated (" +
                              brief(frames.neighbour_correlation) +
                              "), and taken as independent: standard deviations are too small");
  }

  std::string file_;
  LogSensor sensor_;
  const CalibrationOptions& options_;
  CsvTable table_{};
  std::map<std::string, std::size_t> columns_{};
  std::vector<std::size_t> readings_{};
  std::vector<std::vector<double>> unloaded_{};
  std::vector<std::size_t> unloaded_lines_{};
  std::vector<double> steps_{};  // of each reading's numbers; 0: none
  std::set<std::size_t> numbers_{};
  std::vector<Diagnostic> problems_{};
  PressLogFile result_{};
};

}  // namespace

PressLogFile read_press_log(const std::filesystem::path& path, const AnyScene& scene,
                            const CalibrationOptions& options) {
  return Reader(path, scene, options).read();
}

}  // namespace tactile_net::frames
