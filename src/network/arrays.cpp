#include "tactile_net/network/arrays.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace tactile_net {
namespace {

/// What the names of an array's resistors begin with (src/network/realizations).
constexpr std::array<std::pair<std::string_view, Array>, 9> prefixes = {
    {{"Rk", Array::kernel},
     {"Rt", Array::transposed},
     {"Rs", Array::stabiliser},
     {"Re", Array::feedback},
     {"Rg", Array::ground},
     {"Ri", Array::inputs},
     {"Ra", Array::conductances},
     {"Rb", Array::conductances},
     {"R", Array::conductances}}};

bool is_digit(char one) { return one >= '0' && one <= '9'; }

/// Takes the next number off a text.
std::size_t take_number(std::string_view& text, std::size_t otherwise) {
  const auto begin = std::find_if(text.begin(), text.end(), is_digit);
  const auto end = std::find_if_not(begin, text.end(), is_digit);
  std::size_t number = otherwise;
  (void)std::from_chars(std::to_address(begin), std::to_address(end), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return number;
}

}  // namespace

std::string_view name(Array array) noexcept {
  switch (array) {
    case Array::conductances:
      return "P";
    case Array::kernel:
      return "K";
    case Array::transposed:
      return "K transposed";
    case Array::stabiliser:
      return "stabiliser";
    case Array::feedback:
      return "residuals' feedback";
    case Array::ground:
      return "to ground";
    case Array::inputs:
      return "inputs";
    case Array::inside:
      return "converters and inverters";
  }
  return {};
}

ResistorPlace place_of(std::string_view resistor) {
  ResistorPlace place;
  std::string_view numbers = resistor;
  if (const std::size_t dot = resistor.find('.'); dot != std::string_view::npos) {
    place.array = Array::inside;
    numbers = resistor.substr(dot);
  } else {
    const auto letters = std::find_if(resistor.begin(), resistor.end(), is_digit);
    const std::string_view prefix(resistor.begin(), letters);
    for (const auto& [begins_with, array] : prefixes)
      if (prefix == begins_with) place.array = array;
  }
  place.row = take_number(numbers, 0);
  place.column = take_number(numbers, place.row);
  // Entry (i, j) of K' stands at reading i and traction j like K's, in an array that is turned.
  return place;
}

std::string same_entry(std::string_view resistor) {
  if (place_of(resistor).array != Array::transposed) return {};
  return "Rk" + std::string(resistor.substr(2));
}

}  // namespace tactile_net
