#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/effect_values.hpp"
#include "scene/sections.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

namespace {

constexpr Rule weight_range{"must be > 0 and at most 1",
                            [](double x) noexcept { return x > 0.0 && x <= 1.0; }};

/// The knots of a temperature that changes.
///
/// @param timed  the scene has a table [time]; a problem where it has none
PiecewiseLinear read_trajectory(const Value& trajectory, bool timed) {
  PiecewiseLinear result;
  if (!timed)
    trajectory.problem("changes over time, and this scene has none",
                       "add [time], or give one change = 10.0");
  auto knots = trajectory.tables();
  if (knots && knots->empty())
    trajectory.problem("must hold at least one knot", "trajectory = [{ t = 0.0, change = 0.0 }]");
  for (Table& knot : knots.value_or(std::vector<Table>{})) {
    const auto t = knot.required("t", "when, in seconds from the first frame: t = 0.5");
    const auto change = knot.required("change", "in kelvin: change = 10.0");
    const double time = t ? t->number(not_negative, in_seconds).value_or(0.0) : 0.0;
    if (t && !result.times.empty() && time <= result.times.back())
      t->misfit("must be later than the knot before");
    result.times.push_back(time);
    result.values.push_back(change ? change->number(any_number, in_kelvin).value_or(0.0) : 0.0);
    knot.finish();
  }
  return result;
}

/// Reads the tables of one scene's sensor effects.
class EffectReader : private EffectValues {
 public:
  explicit EffectReader(const SensorOfEffects& sensor) : EffectValues(sensor), sensor_(sensor) {}

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
          term.fraction = fraction->number(proper_fraction).value_or(0.0);
        if (const auto time = one.required("time", "its relaxation time, seconds: time = 0.1"))
          term.time = time->number(positive, in_seconds).value_or(1.0);
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
      result.fraction = read_leak(*fraction);
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
    for (const Quantity quantity : sensor_.reads) result.offset[quantity] = 0.0;
    if (const auto offset = table.value("offset"))
      result.offset = numbers_per_quantity(*offset, any_number);
    const auto trajectory = table.value("trajectory");
    const auto change = table.required(
        "change", "from the temperature of calibration, in kelvin: change = 10.0", {"trajectory"});
    if (change && trajectory)
      trajectory->problem("and temperature.change exclude each other", "keep one of the two");
    if (change) result.change = {{0.0}, {change->number(any_number, in_kelvin).value_or(0.0)}};
    if (trajectory) result.change = read_trajectory(*trajectory, sensor_.timed);
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
    if (constant) result.time_constant = constant->number(not_negative, in_seconds).value_or(0.0);
    if (cutoff)
      result.time_constant =
          1.0 / (2.0 * std::numbers::pi * cutoff->number(positive, in_hertz).value_or(1.0));
    table.finish();
    return result;
  }

  Sampling sampling(Table table, const std::optional<Timing>& time) const {
    Sampling result;
    if (const auto aperture =
            table.required("aperture", "the length of the window, seconds: aperture = 1e-3")) {
      result.aperture = aperture->number(not_negative, in_seconds).value_or(0.0);
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
    if (const auto freedom = table.value("degrees"))
      result.degrees = freedom->number(positive).value_or(result.degrees);
    if (const auto share = table.value("model_share"))
      result.model_share = share->number(not_negative).value_or(result.model_share);
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
      result.range = ranges_per_quantity(*value);
    table.finish();
    return result;
  }

  Quantization quantization(Table table) const {
    Quantization result;
    if (const auto bits = table.required("bits", "the converter's resolution: bits = 12"))
      result.bits = static_cast<int>(bits->integer(1, 32).value_or(result.bits));
    if (const auto value = table.required(
            "range", "the lowest and the highest reading that it can show: range = [-1.0, 1.0]")) {
      require_one_unit(*value);
      result.range = ranges_per_quantity(*value);
    }
    table.finish();
    return result;
  }

  StuckTaxels stuck_taxels(Table table) const {
    StuckTaxels result;
    const auto indices =
        table.required("indices", "the numbers of the taxels, from 0: indices = [3, 17]");
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
    if (const auto indices =
            table.required("indices", "the numbers of the taxels, from 0: indices = [3, 17]")) {
      dead = taxels(*indices);
      if (sensor_.taxels > 0 && dead.size() == sensor_.taxels)
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

  /// Beyond this a taxel would give away more than it has.
  [[nodiscard]] double read_leak(const Value& fraction) const {
    const double most = 1.0 / static_cast<double>(sensor_.most_neighbours);
    const double leak = fraction.number(any_number).value_or(0.0);
    if (leak >= 0.0 && leak <= most) return leak;
    fraction.misfit("must be from 0 to " + brief(most),
                    sensor_.skin == nullptr ? ""
                                            : "1 over the most neighbours that a taxel has: " +
                                                  std::to_string(sensor_.most_neighbours));
    return 0.0;
  }

  const SensorOfEffects& sensor_;
};

}  // namespace

void read_sensor_effects(Table& root, const SensorOfEffects& sensor,
                         const std::optional<Timing>& time, SensorEffects& effects) {
  const EffectReader reader(sensor);
  const auto table = [&](std::string_view key) { return table_of(root.value(key)); };
  // An effect that shows only in how readings change.
  const auto timed = [&](std::string_view key) {
    const auto value = root.value(key);
    if (value && !sensor.timed)
      value->problem("shows over time, and this scene has none",
                     "add [time], duration = 1.0, rate = 100.0");
    return table_of(value);
  };
  if (const auto t = timed("viscoelasticity")) effects.viscoelasticity = reader.viscoelasticity(*t);
  if (const auto t = table("hysteresis")) effects.hysteresis = reader.hysteresis(*t);
  if (const auto t = table("crosstalk")) effects.crosstalk = reader.crosstalk(*t);
  if (const auto t = table("gain_error")) effects.gain_error = reader.gain_error(*t);
  if (const auto t = table("offset_error")) effects.offset_error = reader.offset_error(*t);
  if (const auto t = table("temperature")) effects.temperature = reader.temperature(*t);
  if (const auto t = timed("low_pass")) effects.low_pass = reader.low_pass(*t);
  if (const auto t = timed("sampling")) effects.sampling = reader.sampling(*t, time);
  if (const auto t = table("noise")) effects.noise = reader.noise(*t);
  if (const auto t = table("taxel_noise")) effects.taxel_noise = reader.taxel_noise(*t);
  if (const auto t = table("saturation")) effects.saturation = reader.saturation(*t);
  if (const auto t = table("quantization")) effects.quantization = reader.quantization(*t);
  if (const auto t = table("stuck_taxels")) effects.stuck_taxels = reader.stuck_taxels(*t);
  if (const auto t = table("dead_taxels")) effects.dead_taxels = reader.dead_taxels(*t);
}

}  // namespace tactile_net
