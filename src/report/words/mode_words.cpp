#include "tactile_net/report/words/mode_words.hpp"

#include <cmath>

#include "report/words/number_words.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {
namespace {

constexpr double pure = 0.9;  // share from which a mode is said to have one wavelength

std::string whole_percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

}  // namespace

std::string in_words(const TractionMode& mode, const std::optional<Units>& units) {
  std::string text = mode.unknown ? std::string(line_name(*mode.unknown)) + " traction"
                                  : "normal (" + whole_percent(mode.normal_share) +
                                        ") with tangential traction (" +
                                        whole_percent(1.0 - mode.normal_share) + ")";
  text += mode.wave_share < 0.5    ? ", of many wavelengths, the strongest: "
          : mode.wave_share < pure ? ", nearly "
                                   : ", ";
  if (!mode.wavelength)
    text += "constant (k = 0)";
  else if (mode.alternating)
    text += "alternating from taxel to taxel (Nyquist)";
  else
    text += "wavelength " + length_in_words(units, *mode.wavelength);
  if (mode.unknown && mode.parity != Parity::neither)
    text +=
        std::string(", ") + (mode.parity == Parity::even ? "even" : "odd") + " about the centre";
  return text;
}

std::string in_words(const ModeSpace& space, const std::optional<Units>& units) {
  if (space.dimension == 0) return {};
  std::string text = in_words(space.modes.front(), units);
  if (space.dimension == 1) return text;
  text += "; and " + std::to_string(space.dimension - 1) + " combination" +
          (space.dimension > 2 ? "s" : "") + " more";
  if (std::isinf(space.longest))
    text += ", from constant ones to wavelength " + length_in_words(units, space.shortest);
  else if (space.longest > 0.0)
    text += ", of wavelengths " + length_in_words(units, space.longest) + " to " +
            length_in_words(units, space.shortest);
  return text;
}

std::string in_short(const ModeSpace& space, const std::optional<Units>& units) {
  if (space.dimension == 0) return "-";
  if (space.dimension > 1)
    return std::to_string(space.dimension) + " modes" + wavelengths_in_short(space, units);
  const TractionMode& mode = space.modes.front();
  return std::string(
             line_name(mode.normal_share >= 0.5 ? Traction::normal : Traction::tangential_y)) +
         ", " +
         (!mode.wavelength   ? "k = 0"
          : mode.alternating ? "alternating"
                             : "wavelength " + length_in_words(units, *mode.wavelength));
}

std::string wavelengths_in_short(const ModeSpace& space, const std::optional<Units>& units) {
  if (space.longest == 0.0) return {};
  return ", wavelengths " + length_in_words(units, space.shortest) + " to " +
         (std::isinf(space.longest) ? "k = 0" : length_in_words(units, space.longest));
}

std::string in_words(const DftNullMode& mode) {
  const std::string traction = "the " + std::string(line_name(mode.unknown)) + " traction";
  if (!mode.wavelength) return "the mean of " + traction + " (k = 0)";
  if (mode.alternating) return traction + " that alternates from taxel to taxel (Nyquist)";
  return "a ripple of " + traction + " with wavelength " + brief(*mode.wavelength);
}

}  // namespace tactile_net::report
