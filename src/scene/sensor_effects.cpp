#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/sections.hpp"

namespace tactile_net {

namespace {

constexpr Rule up_to_half{"must be from 0 to 0.5",
                          [](double x) noexcept { return x >= 0.0 && x <= 0.5; }};
constexpr Rule share{"must be >= 0 and < 1", [](double x) noexcept { return x >= 0.0 && x < 1.0; }};
constexpr Rule weight_range{"must be > 0 and at most 1",
                            [](double x) noexcept { return x > 0.0 && x <= 1.0; }};

using Numbers = std::vector<double>;
using Indices = std::optional<std::vector<std::size_t>>;  // absent: all taxels

/// Reads the tables of one scene's sensor effects.
class Reader {
 public:
  Reader(const Read& read, const SensorArray& array) : read_(read), array_(array) {}

  // --- shared ---

  /// A table that names every quantity that is read and no other; `one` reads each value, given the
  /// unit of that quantity's readings.
  template <typename T>
  PerQuantity<T> of_each(Table table, auto one) const {
    PerQuantity<T> result;
    for (const Quantity quantity : quantities) {
      const bool is_read =
          std::find(array_.reads.begin(), array_.reads.end(), quantity) != array_.reads.end();
      const auto value = is_read && read_.reads_complete
                             ? table.required(name(quantity),
                                              "the table names every quantity that "
                                              "sensor.reads does")
                             : table.value(name(quantity));
      if (!value) continue;
      if (!is_read && read_.reads_complete)
        value->problem("is of a quantity that sensor.reads does not name", "remove it");
      else if (auto got = one(*value, reading_unit(read_.units, quantity)))
        result[quantity] = std::move(*got);
    }
    table.finish();
    return result;
  }

  /// One value for every quantity, or a table of one for each.
  template <typename T>
  PerQuantity<T> per_quantity(const Value& value, auto one) const {
    if (value.is_table()) return of_each<T>(*value.table(), one);
    PerQuantity<T> result;
    for (const Quantity quantity : array_.reads)
      if (auto got = one(value, reading_unit(read_.units, quantity)))
        result[quantity] = std::move(*got);
    if (array_.reads.empty()) (void)one(value, Unit{});  // what is wrong with it is said anyway
    return result;
  }

  PerQuantity<double> numbers_per_quantity(const Value& value, const Rule& rule) const {
    return per_quantity<double>(
        value, [&](const Value& one, const Unit& unit) { return one.number(rule, unit); });
  }

  static std::uint64_t seed(Table& table) {
    const auto seed = table.value("seed");
    return seed ? static_cast<std::uint64_t>(seed->integer(0, INT64_MAX).value_or(1)) : 1;
  }

  /// Taxels by their numbers.
  std::vector<std::size_t> taxels(const Value& indices) const {
    std::vector<std::size_t> result;
    const std::int64_t last =
        array_.count > 0 ? static_cast<std::int64_t>(array_.count) - 1 : most_taxels - 1;
    std::size_t misfits = 0;
    for (const Value& item : indices.list("taxel numbers").value_or(std::vector<Value>{})) {
      if (misfits == most_misfits) break;
      const auto index = item.integer(0, last, "taxels are numbered from 0");
      const auto taxel = static_cast<std::size_t>(index.value_or(0));
      if (!index) {
        ++misfits;
      } else if (std::find(result.begin(), result.end(), taxel) != result.end()) {
        ++misfits;
        item.misfit("names a taxel twice", "remove one");
      } else {
        result.push_back(taxel);
      }
    }
    return result;
  }

  /// A list of one value per taxel, or per index where there are some; `indices` are complete.
  std::optional<Numbers> taxel_values(const Value& value, const Rule& rule, const Indices& indices,
                                      const Unit& unit = {}) const {
    auto numbers = value.numbers(rule, unit);
    if (!numbers) return std::nullopt;
    const std::size_t expected = indices ? indices->size() : array_.count;
    if (expected > 0 && numbers->size() != expected) {
      value.problem("must have one value per " + std::string(indices ? "index" : "taxel") + ": " +
                    std::to_string(expected) + " (got " + std::to_string(numbers->size()) + ')');
      return std::nullopt;
    }
    return numbers;
  }

  /// As `taxel_values`, spread over all taxels: 0 where no index is.
  std::optional<Numbers> spread(const Value& value, const Rule& rule, const Indices& indices,
                                const Unit& unit = {}) const {
    auto numbers = taxel_values(value, rule, indices, unit);
    if (!numbers || !indices) return numbers;
    Numbers all(array_.count);
    for (std::size_t i = 0; i < indices->size() && i < numbers->size(); ++i)
      if ((*indices)[i] < all.size()) all[(*indices)[i]] = (*numbers)[i];
    return all;
  }

  Indices optional_indices(Table& table) const {
    const auto value = table.value("indices");
    return value ? std::optional(taxels(*value)) : std::nullopt;
  }

  std::optional<Range> range(const Value& value, const Unit& unit) const {
    const auto ends = value.numbers(any_number, unit);
    if (!ends) return std::nullopt;
    if (ends->size() != 2)
      value.problem("must be two numbers, the lowest and the highest reading",
                    "range = [-1.0, 1.0]");
    else if (!((*ends)[0] < (*ends)[1]))
      value.problem("must begin with the lower of its two numbers", "range = [-1.0, 1.0]");
    else if (!std::isfinite((*ends)[1] - (*ends)[0]))
      value.problem("is wider than a double can hold");
    else
      return Range{(*ends)[0], (*ends)[1]};
    return std::nullopt;
  }

  // --- one function for each table, in the order of the signal path ---

  Viscoelasticity viscoelasticity(Table table) const {
    Viscoelasticity result;
    const auto terms = table.required(
        "terms", "the modulus' Prony series: terms = [{ fraction = 0.3, time = 0.1 }]");
    if (terms) {
      double all = 0.0;
      for (Table& one : terms->tables().value_or(std::vector<Table>{})) {
        PronyTerm term;
        if (const auto fraction =
                one.required("fraction", "the share of the modulus that relaxes: fraction = 0.3"))
          term.fraction = fraction->number(share).value_or(0.0);
        if (const auto time = one.required("time", "its relaxation time, seconds: time = 0.1"))
          term.time = time->number(positive).value_or(1.0);
        one.finish();
        all += term.fraction;
        result.terms.push_back(term);
      }
      if (all >= 1.0)
        terms->problem("must leave some of the modulus: the fractions must add up to less than 1",
                       "what is left, 1 - their sum, is the modulus in the long run");
    }
    table.finish();
    return result;
  }

  Hysteresis hysteresis(Table table) const {
    Hysteresis result;
    const auto weights = table.required(
        "weights", "the share of the reading that goes through each play: weights = [0.1, 0.1]");
    if (weights) {
      result.weights = weights->numbers(weight_range).value_or(Numbers{});
      if (std::accumulate(result.weights.begin(), result.weights.end(), 0.0) > 1.0 + 1e-12)
        weights->problem("must add up to 1 at most");
    }
    if (const auto thresholds = table.required(
            "thresholds",
            "how far each play lags behind, in the unit of the readings: thresholds = [0.01, "
            "0.02]"))
      result.thresholds =
          per_quantity<Numbers>(*thresholds, [&](const Value& one, const Unit& unit) {
            auto numbers = one.numbers(not_negative, unit);
            if (numbers && !result.weights.empty() && numbers->size() != result.weights.size()) {
              one.problem(
                  "must have one threshold per weight: " + std::to_string(result.weights.size()) +
                  " (got " + std::to_string(numbers->size()) + ')');
              numbers.reset();
            }
            return numbers;
          });
    table.finish();
    return result;
  }

  Crosstalk crosstalk(Table table) const {
    Crosstalk result;
    if (const auto fraction = table.required(
            "fraction", "the share of a signal that leaks to each neighbour: fraction = 0.02"))
      result.fraction = fraction->number(up_to_half).value_or(0.0);
    table.finish();
    return result;
  }

  GainError gain_error(Table table) const {
    GainError result;
    result.seed = seed(table);
    const auto indices = optional_indices(table);
    const auto values = table.value("values");
    const auto rms = table.required("rms", "of the relative error: rms = 0.01", {"values"});
    if (values) result.values = spread(*values, any_number, indices).value_or(Numbers{});
    if (rms) result.rms = rms->number(not_negative).value_or(0.0);
    exclude(values, rms);
    table.finish();
    return result;
  }

  OffsetError offset_error(Table table) const {
    OffsetError result;
    result.seed = seed(table);
    const auto indices = optional_indices(table);
    const auto values = table.value("values");
    const auto rms = table.required("rms", "in the unit of the readings: rms = 1e-3", {"values"});
    if (values)
      result.values = per_quantity<Numbers>(*values, [&](const Value& one, const Unit& unit) {
        return spread(one, any_number, indices, unit);
      });
    if (rms) result.rms = numbers_per_quantity(*rms, not_negative);
    exclude(values, rms);
    table.finish();
    return result;
  }

  TemperatureDrift temperature(Table table) const {
    TemperatureDrift result;
    if (const auto gain = table.value("gain")) result.gain = gain->number(any_number).value_or(0.0);
    for (const Quantity quantity : array_.reads) result.offset[quantity] = 0.0;
    if (const auto offset = table.value("offset"))
      result.offset = numbers_per_quantity(*offset, any_number);
    const auto trajectory = table.value("trajectory");
    const auto change = table.required(
        "change", "from the temperature of calibration, in kelvin: change = 10.0", {"trajectory"});
    if (change && trajectory)
      trajectory->problem("and temperature.change exclude each other", "keep one of the two");
    if (change) result.change = {{0.0}, {change->number(any_number).value_or(0.0)}};
    if (trajectory) result.change = read_trajectory(*trajectory, read_.timed);
    table.finish();
    return result;
  }

  LowPass low_pass(Table table) const {
    LowPass result;
    const auto constant = table.value("time_constant");
    const auto cutoff = table.required(
        "cutoff", "the frequency of half the power, hertz: cutoff = 100.0", {"time_constant"});
    if (cutoff && constant)
      constant->problem("and low_pass.cutoff exclude each other", "keep one of the two");
    if (constant) result.time_constant = constant->number(not_negative).value_or(0.0);
    if (cutoff)
      result.time_constant =
          1.0 / (2.0 * std::numbers::pi * cutoff->number(positive).value_or(1.0));
    table.finish();
    return result;
  }

  Sampling sampling(Table table, const std::optional<Timing>& time) const {
    Sampling result;
    if (const auto aperture =
            table.required("aperture", "the length of the window, seconds: aperture = 1e-3")) {
      result.aperture = aperture->number(not_negative).value_or(0.0);
      if (time && result.aperture > (1.0 + 1e-9) / time->rate)
        aperture->misfit("must be at most the time from frame to frame, 1 / time.rate",
                         "windows do not overlap");
    }
    table.finish();
    return result;
  }

  NoiseModel noise(Table table) const {
    NoiseModel result;
    if (const auto rms = table.required(
            "rms",
            "the noise of one reading, in its unit: rms = 1e-4, or one for each quantity: "
            "rms = { strain_x = 1e-4, stress_x = 20.0 }")) {
      result.weights_rows = rms->is_table();
      result.rms = numbers_per_quantity(*rms, result.weights_rows ? positive : not_negative);
    }
    result.seed = seed(table);
    table.finish();
    return result;
  }

  TaxelNoise taxel_noise(Table table) const {
    TaxelNoise result;
    result.seed = seed(table);
    const auto indices = optional_indices(table);
    if (const auto rms = table.required(
            "rms", "of every taxel, or of those of indices: indices = [3, 17], rms = [0.01, 0.02]"))
      result.rms = per_quantity<Numbers>(*rms, [&](const Value& one, const Unit& unit) {
        return spread(one, not_negative, indices, unit);
      });
    table.finish();
    return result;
  }

  Saturation saturation(Table table) const {
    Saturation result;
    if (const auto value =
            table.required("range", "the lowest and the highest reading: range = [-1.0, 1.0]"))
      result.range = per_quantity<Range>(
          *value, [&](const Value& one, const Unit& unit) { return range(one, unit); });
    table.finish();
    return result;
  }

  Converter quantization(Table table) const {
    Converter converter;
    if (const auto bits = table.required("bits", "the converter's resolution: bits = 12"))
      converter.bits = static_cast<int>(bits->integer(1, 32).value_or(converter.bits));
    if (const auto value = table.required(
            "range", "the lowest and the highest reading it can tell: range = [-1.0, 1.0]"))
      if (const auto ends = range(*value, reading_unit(read_.units, array_, *value)))
        converter = {converter.bits, ends->low, ends->high};
    table.finish();
    return converter;
  }

  StuckTaxels stuck_taxels(Table table) const {
    StuckTaxels result;
    const auto indices = table.required("indices", "which taxels, from 0: indices = [3, 17]");
    if (indices) result.indices = taxels(*indices);
    if (const auto values = table.required(
            "values", "what each of them reads, in the unit of the readings: values = [0.1, 0.0]"))
      result.values = per_quantity<Numbers>(*values, [&](const Value& one, const Unit& unit) {
        return taxel_values(one, any_number, std::optional(result.indices), unit);
      });
    table.finish();
    return result;
  }

  std::vector<std::size_t> dead_taxels(Table table) const {
    std::vector<std::size_t> dead;
    if (const auto indices = table.required("indices", "which taxels, from 0: indices = [3, 17]")) {
      dead = taxels(*indices);
      if (array_.count > 0 && dead.size() == array_.count)
        indices->problem("leaves no taxel alive", "at least one taxel must read something");
    }
    table.finish();
    return dead;
  }

 private:
  static void exclude(const std::optional<Value>& values, const std::optional<Value>& rms) {
    if (values && rms)
      values->problem("and rms exclude each other", "list the errors, or draw them");
  }

  const Read& read_;
  const SensorArray& array_;
};

}  // namespace

void read_sensor_effects(Table& root, const Read& read, Scene& scene) {
  const Reader reader(read, scene.sensor);
  const auto table = [&](std::string_view key) { return table_of(root.value(key)); };
  // An effect that shows only in how readings change.
  const auto timed = [&](std::string_view key) {
    const auto value = root.value(key);
    if (value && !read.timed)
      value->problem("shows over time, and this scene has none",
                     "add [time], duration = 1.0, rate = 100.0");
    return table_of(value);
  };
  if (const auto t = timed("viscoelasticity")) scene.viscoelasticity = reader.viscoelasticity(*t);
  if (const auto t = table("hysteresis")) scene.hysteresis = reader.hysteresis(*t);
  if (const auto t = table("crosstalk")) scene.crosstalk = reader.crosstalk(*t);
  if (const auto t = table("gain_error")) scene.gain_error = reader.gain_error(*t);
  if (const auto t = table("offset_error")) scene.offset_error = reader.offset_error(*t);
  if (const auto t = table("temperature")) scene.temperature = reader.temperature(*t);
  if (const auto t = timed("low_pass")) scene.low_pass = reader.low_pass(*t);
  if (const auto t = timed("sampling")) scene.sampling = reader.sampling(*t, scene.time);
  if (const auto t = table("noise")) scene.noise = reader.noise(*t);
  if (const auto t = table("taxel_noise")) scene.taxel_noise = reader.taxel_noise(*t);
  if (const auto t = table("saturation")) scene.saturation = reader.saturation(*t);
  if (const auto t = table("quantization")) scene.quantization = reader.quantization(*t);
  if (const auto t = table("stuck_taxels")) scene.stuck_taxels = reader.stuck_taxels(*t);
  if (const auto t = table("dead_taxels")) scene.dead_taxels = reader.dead_taxels(*t);
}

}  // namespace tactile_net
