#include "frames/header_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tactile_net/frames/frame_clock.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::frames {
namespace {

/// What sensors and converters give before they are calibrated.
constexpr std::array<std::string_view, 23> raw_units = {
    "V",   "mV",  "uV",  "µV",  "counts", "count", "digits", "digit",
    "LSB", "lsb", "ADC", "adc", "px",     "pix",   "pixel",  "pixels",
    "pF",  "fF",  "Ohm", "ohm", "kOhm",   "kohm",  "raw"};

bool is_raw(std::string_view text) {
  return std::find(raw_units.begin(), raw_units.end(), text) != raw_units.end();
}

/// Whether two factors are the same but for a sensor's own gain.
bool is_about(double one, double other) { return one < 3.0 * other && other < 3.0 * one; }

std::string in_scene(const WantedUnit& wanted) {
  return wanted.unit.name.empty() ? "without a unit" : "in " + std::string(wanted.unit.name);
}

}  // namespace

bool names_unit(std::string_view text) {
  return dimension_named(text) || time_unit_named(text) || is_raw(text);
}

HeaderUnit header_unit(std::string_view stated, const WantedUnit& wanted) {
  const bool has_gain = wanted.gain != 1.0;
  const auto unit = unit_named(wanted.dimension, stated);
  if (!unit) {
    const auto other = dimension_named(stated);
    if (!other && !is_raw(stated)) return {.understood = false};
    if (has_gain) return {};
    const std::string kind = wanted.dimension == Dimension::none
                                 ? "a strain"
                                 : "a " + std::string(name(wanted.dimension));
    return {.problem = "the header gives the unit [" + std::string(stated) +
                       "], and this reading is " + kind + ", " + in_scene(wanted),
            .what_to_do = other == Dimension::point_force && wanted.dimension == Dimension::stress
                              ? "readings are stresses: divide newtons by the area of a taxel. "
                                "Under [calibration], gain = 1 / area: 1 N on 16 mm^2 is 62.5 kPa"
                              : "under [calibration], gain says what one [" + std::string(stated) +
                                    "] is; or correct the header"};
  }
  const Unit factor{"", unit->multiplier * wanted.unit.divisor,
                    unit->divisor * wanted.unit.multiplier};
  const double times = factor.to_si(1.0);
  const double gain = std::abs(wanted.gain);
  if (factor.is_si() || times == 1.0 || (has_gain && is_about(gain, times))) return {};
  if (!has_gain || is_about(gain, 1.0)) return {.factor = factor};
  return {.problem = "the header gives the unit [" + std::string(stated) +
                     "], and by calibration.gain one is " + brief(gain) + ' ' +
                     std::string(wanted.unit.name),
          .what_to_do = "remove the unit from the header if its numbers are raw, or correct gain"};
}

}  // namespace tactile_net::frames
