#include "frames/column_places.hpp"

#include <algorithm>
#include <stdexcept>

#include "numeric/csv_fields.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::frames {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw std::invalid_argument(option(Option::columns) + ": " + message +
                              "; a list such as 2-42, or t=1,4-44: numbers of columns from 1, "
                              "ranges or names");
}

}  // namespace

ColumnPlaces column_places(
    std::string_view list, std::size_t row, std::optional<std::size_t> wanted,
    const std::function<std::optional<std::size_t>(std::string_view)>& place_of) {
  ColumnPlaces places;
  const auto place = [&](std::string_view item) {
    const auto number = whole_number(item);
    if (!number) {
      if (const auto named = place_of(item)) return *named;
      fail("the file has no column '" + std::string(item) + "'");
    }
    if (*number < 1 || *number > row)
      fail("there is no column " + std::string(item) + ": the file has " + std::to_string(row));
    return *number - 1;
  };
  for (bool more = true; more;) {
    const std::string_view item = trimmed(take_field(list, more, {','}));
    if (item.empty()) fail("an item is empty");
    if (item.starts_with("t=")) {
      if (places.time) fail("two columns of times");
      const std::string_view clock = item.substr(2);
      const std::size_t plus = clock.find('+');
      places.time = place(clock.substr(0, plus));
      if (plus != clock.npos) places.nanoseconds = place(clock.substr(plus + 1));
      continue;
    }
    const std::size_t dash = item.find('-');
    const auto first = whole_number(item.substr(0, dash));
    const auto last = dash == item.npos ? first : whole_number(item.substr(dash + 1));
    if (dash == item.npos || !first || !last) {  // a number, or a name that may have a dash
      places.readings.push_back(place(item));
      continue;
    }
    if (*last < *first) fail("the range " + std::string(item) + " runs backwards");
    (void)place(item.substr(dash + 1));  // so that a range is never longer than the row
    (void)place(item.substr(0, dash));
    for (std::size_t i = *first; i <= *last; ++i) places.readings.push_back(i - 1);
    if (places.readings.size() > 2 * row) fail("a column stands twice");
  }
  std::vector<std::size_t> sorted = places.readings;
  for (const auto& clock : {places.time, places.nanoseconds})
    if (clock) sorted.push_back(*clock);
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) fail("column " + std::to_string(*twice + 1) + " stands twice");
  if (wanted && places.readings.size() != *wanted)
    fail("names " + std::to_string(places.readings.size()) + " columns of readings, and " +
         std::to_string(*wanted) + " are read");
  return places;
}

std::string places_after(std::size_t others, std::size_t wanted) {
  return std::to_string(others + 1) + "-" + std::to_string(others + wanted);
}

}  // namespace tactile_net::frames
