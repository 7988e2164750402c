#include "scene/calibration_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/calibration_file.hpp"
#include "scene/references.hpp"
#include "tactile_net/calibration/calibration_options.hpp"

namespace tactile_net {
namespace {

constexpr Rule not_zero{"must not be 0", [](double x) noexcept { return x != 0.0; }};
/// Numbers of the frames that are kept until their mean, the baseline, is known: 64 MiB.
constexpr std::size_t most_kept = std::size_t{1} << 23;

/// What the sensor's calibration says of every reading, and how it is written.
struct Coefficient {
  std::string_view name;
  std::vector<double> Calibration::*member;
  Rule rule;
  bool has_unit;  // that of the readings; else of the raw numbers
  double absent;  // what it is where nothing says it
};

constexpr std::array coefficients = {
    Coefficient{"gain", &Calibration::gain, not_zero, true, 1.0},
    Coefficient{"baseline", &Calibration::baseline, any_number, false, 0.0},
    Coefficient{"offset", &Calibration::offset, any_number, true, 0.0}};

/// What `calibrate` writes: number = gains * reading + offsets, with gains near 1 whatever the
/// units.
constexpr Coefficient sensor_gains{"gains", &Calibration::gain, not_zero, false, 1.0};
constexpr Coefficient sensor_offsets{"offsets", &Calibration::baseline, any_number, false, 0.0};

class CalibrationReader {
 public:
  explicit CalibrationReader(const CalibratedReadings& readings)
      : names_(readings.names), units_(readings.units), quantities_(readings.quantities) {}

  /// How many readings there are; 0: the sensor was not understood.
  [[nodiscard]] bool known() const noexcept { return !units_.empty(); }
  [[nodiscard]] bool any_unit() const {
    return std::any_of(units_.begin(), units_.end(),
                       [](const Unit& unit) { return !unit.is_si(); });
  }
  [[nodiscard]] Unit unit(const Coefficient& coefficient, std::size_t reading) const {
    return coefficient.has_unit ? units_[reading] : Unit{};
  }

  [[nodiscard]] Calibration without_table() const {
    Calibration calibration;
    for (const Coefficient& coefficient : coefficients)
      for (std::size_t i = 0; i < units_.size(); ++i)
        (calibration.*coefficient.member).push_back(unit(coefficient, i).to_si(coefficient.absent));
    return calibration;
  }

  /// What the sensor does to a reading, in place of what undoes it.
  void read_inverse(const Value& value, std::vector<double>& gain) const {
    std::vector<double> numbers(gain.size(), 1.0);
    read(value, sensor_gains, numbers);
    for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = units_[i].to_si(1.0 / numbers[i]);
  }

  /// One number for all readings, one for each quantity, or one for each reading.
  void read(const Value& value, const Coefficient& coefficient,
            std::vector<double>& numbers) const {
    if (value.is_table())
      read_quantities(*value.table(), coefficient, numbers);
    else if (value.is_list())
      read_list(value, coefficient, numbers);
    else
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = value.number(coefficient.rule, unit(coefficient, i));
        if (!number) return;
        numbers[i] = *number;
      }
  }

  void read(const CalibrationColumns& from, const Value& file, Calibration& calibration) const {
    for (const Coefficient& coefficient : coefficients) {
      const auto found = from.find(coefficient.name);
      if (found == from.end()) continue;
      for (std::size_t i = 0; i < found->second.size(); ++i) {
        const double number = unit(coefficient, i).to_si(found->second[i]);
        if (!coefficient.rule.holds(number) || !std::isfinite(number)) {
          file.problem(
              "names a file whose " + std::string(coefficient.name) + " of reading " +
              std::to_string(i) + ' ' +
              std::string(coefficient.rule.holds(number) ? "is too large" : coefficient.rule.text));
          return;
        }
        (calibration.*coefficient.member)[i] = number;
      }
    }
  }

  [[nodiscard]] std::optional<FrameRange> frames(const Value& value) const {
    const auto list = value.list("two frame numbers");
    if (!list) return std::nullopt;
    if (list->size() != 2) {
      value.problem("must be two frame numbers, the first and the last",
                    "baseline_frames = [0, 99]");
      return std::nullopt;
    }
    const std::size_t most = most_kept / std::max<std::size_t>(units_.size(), 1);
    const auto at = [&](std::size_t i) {
      return (*list)[i].integer(0, static_cast<std::int64_t>(most) - 1,
                                "these frames are kept until their mean is known; the first frame "
                                "is frame 0");
    };
    const auto first = at(0);
    const auto last = at(1);
    if (!first || !last) return std::nullopt;
    if (*first > *last)
      value.problem("must begin with the earlier frame", "baseline_frames = [0, 99]");
    return FrameRange{static_cast<std::size_t>(*first), static_cast<std::size_t>(*last)};
  }

 private:
  void read_list(const Value& value, const Coefficient& coefficient,
                 std::vector<double>& numbers) const {
    const auto list = value.list("numbers");
    if (list->size() != numbers.size()) {
      value.problem("must have one value per reading, channel after channel: " +
                        std::to_string(numbers.size()) + " (got " + std::to_string(list->size()) +
                        ')',
                    "one number for all, or one for each quantity: { stress_x = 0.25 }");
      return;
    }
    std::size_t misfits = 0;
    for (std::size_t i = 0; i < numbers.size() && misfits < most_misfits; ++i)
      if (const auto number = (*list)[i].number(coefficient.rule, unit(coefficient, i)))
        numbers[i] = *number;
      else
        ++misfits;
  }

  void read_quantities(Table table, const Coefficient& coefficient,
                       std::vector<double>& numbers) const {
    for (const std::string_view quantity : names_) {
      const auto value =
          table.required(quantity, "the table names every quantity that sensor.reads does");
      if (!value) continue;
      const auto first = std::find(quantities_.begin(), quantities_.end(), quantity);
      const auto number =
          value->number(coefficient.rule,
                        unit(coefficient, static_cast<std::size_t>(first - quantities_.begin())));
      for (std::size_t i = 0; i < numbers.size(); ++i)
        if (quantities_[i] == quantity) numbers[i] = number.value_or(1.0);
    }
    table.finish();
  }

  std::span<const std::string_view> names_;       // as sensor.reads has them
  std::span<const Unit> units_;                   // of each reading
  std::span<const std::string_view> quantities_;  // of each reading
};

/// Where gains and offsets come from: facts that are kept and not computed with.
void read_origin(Table& table) {
  if (const auto from = table.value("from")) static_cast<void>(from->text());
  if (const auto presses = table.value("presses"))
    static_cast<void>(presses->integer(1, std::numeric_limits<std::int64_t>::max()));
  for (const char* key : {"chi_squared", "dof"})
    if (const auto number = table.value(key)) static_cast<void>(number->number(not_negative));
  if (const auto sds = table.value("sd"))
    if (auto sd = sds->table()) {
      for (std::size_t i = 0; i < pad_parameter_count; ++i)
        if (const auto number = sd->value(name(static_cast<PadParameter>(i))))
          static_cast<void>(number->number(not_negative));
      sd->finish();
    }
}

/// Raw numbers that say that there is no value.
std::vector<double> missing_codes(const Value& value) {
  constexpr std::size_t most_codes = 16;  // each number of a recording is compared with all
  std::vector<double> codes;
  const auto list = value.list("numbers");
  if (!list) return codes;
  if (list->size() > most_codes)
    value.problem("must have at most " + std::to_string(most_codes) + " numbers",
                  "missing = [65535, -1]: what the recording has in place of a reading");
  for (std::size_t i = 0; i < std::min(list->size(), most_codes); ++i)
    if (const auto number = (*list)[i].number(any_number)) codes.push_back(*number);
  return codes;
}

/// Coefficients in the columns of a file beside the scene.
CalibrationColumns columns_of(const Value& value, const std::filesystem::path& folder,
                              std::span<const std::string> readings) {
  const auto path = path_beside(value, folder, "file = \"pad-calibration.csv\"");
  if (!path) return {};
  std::array<std::string_view, coefficients.size()> names;
  std::transform(coefficients.begin(), coefficients.end(), names.begin(),
                 [](const Coefficient& coefficient) { return coefficient.name; });
  try {
    return read_calibration_file(*path, names, readings);
  } catch (const std::runtime_error& error) {
    value.problem("names a file that is not in order: " + std::string(error.what()),
                  "a header with gain, baseline, offset, or some of them, then a row per reading");
    return {};
  }
}

}  // namespace

std::optional<Calibration> read_calibration(const std::optional<Table>& given,
                                            const std::filesystem::path& folder,
                                            const CalibratedReadings& readings) {
  const CalibrationReader reader(readings);
  if (!given) return reader.any_unit() ? std::optional(reader.without_table()) : std::nullopt;
  Table table = *given;
  Calibration calibration = reader.without_table();
  const auto file = table.value("file");
  CalibrationColumns from;
  if (file && reader.known()) {
    from = columns_of(*file, folder, readings.ids);
    reader.read(from, *file, calibration);
  }
  for (const Coefficient& coefficient : coefficients) {
    const auto value = table.value(coefficient.name);
    if (!value) continue;
    if (from.contains(coefficient.name))
      value->problem("is given in calibration.file too", "keep one of the two");
    else if (reader.known())
      reader.read(*value, coefficient, calibration.*coefficient.member);
  }
  if (const auto codes = table.value("missing")) calibration.missing = missing_codes(*codes);
  if (const auto frames = table.value("baseline_frames")) {
    if (table.value("baseline") || from.contains("baseline"))
      frames->problem("and a given baseline exclude each other", "keep one of the two");
    else
      calibration.baseline_frames = reader.frames(*frames);
  }
  const auto exclude = [&](const Value& value, std::initializer_list<std::string_view> others) {
    for (const std::string_view other : others)
      if (from.contains(other) || table.value(other))
        value.problem("and calibration." + std::string(other) + " exclude each other",
                      "number = gains * reading + offsets, or reading = gain * (number - baseline) "
                      "+ offset");
  };
  if (const auto value = table.value(sensor_gains.name)) {
    exclude(*value, {"gain", "offset"});
    if (reader.known()) reader.read_inverse(*value, calibration.gain);
  }
  if (const auto value = table.value(sensor_offsets.name)) {
    exclude(*value, {"baseline", "baseline_frames", "offset"});
    if (reader.known()) reader.read(*value, sensor_offsets, calibration.baseline);
  }
  read_origin(table);
  table.finish();
  return reader.known() ? std::optional(std::move(calibration)) : std::nullopt;
}

}  // namespace tactile_net
