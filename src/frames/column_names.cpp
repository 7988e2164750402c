#include "frames/column_names.hpp"

#include <algorithm>
#include <array>

#include "numeric/csv_fields.hpp"
#include "numeric/lower_case.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/frames/frame_clock.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::frames {
namespace {

constexpr std::array<std::string_view, 12> generic = {"",        "taxel",   "sensor", "channel",
                                                      "ch",      "column",  "col",    "cell",
                                                      "element", "reading", "value",  "taxel_nr"};
constexpr std::array<std::string_view, 7> names_of_time = {
    "t", "time", "timestamp", "time_stamp", "stamp", "zeit", "elapsed"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

template <std::size_t size>
bool holds(const std::array<std::string_view, size>& table, std::string_view text) {
  return std::find(table.begin(), table.end(), text) != table.end();
}

/// Takes what stands between brackets at the end off the text; empty: there are none.
std::string_view take_brackets(std::string_view& text) {
  if (text.empty() || (text.back() != ']' && text.back() != ')')) return {};
  const std::size_t open = text.rfind(text.back() == ']' ? '[' : '(');
  if (open == text.npos) return {};
  const std::string_view inside = text.substr(open + 1, text.size() - open - 2);
  text = trimmed(text.substr(0, open));
  return inside;
}

/// Small letters; blanks, dots and hyphens become one '_'.
std::string stem_of(std::string_view text) {
  std::string stem;
  for (const char c : text) {
    const bool joint = c == ' ' || c == '.' || c == '-' || c == '_' || c == '\t';
    if (joint && (stem.empty() || stem.back() == '_')) continue;
    stem += joint ? '_' : lower_case(c);
  }
  while (!stem.empty() && stem.back() == '_') stem.pop_back();
  return stem;
}

}  // namespace

std::string ColumnName::plain() const {
  if (!number) return stem;
  return stem.empty() ? std::to_string(*number) : stem + "_" + std::to_string(*number);
}

ColumnName column_name(std::string_view text) {
  ColumnName name;
  std::string_view rest = trimmed(text);
  std::string_view brackets = take_brackets(rest);
  if (!brackets.empty() && !all_digits(brackets)) {
    name.unit = brackets;
    brackets = take_brackets(rest);  // "stress_x[0] [Pa]"
  }
  if (all_digits(brackets)) {
    name.number = whole_number(brackets);
  } else {
    std::size_t digits = 0;
    while (digits < rest.size() && is_digit(rest[rest.size() - 1 - digits])) ++digits;
    // "stress_x@1" is a channel's own name: the number behind '@' is no taxel's.
    const bool of_depth = digits < rest.size() && rest[rest.size() - 1 - digits] == '@';
    if (digits > 0 && !of_depth) {
      name.number = whole_number(rest.substr(rest.size() - digits));
      rest.remove_suffix(digits);
    }
  }
  name.stem = stem_of(rest);
  return name;
}

std::optional<TimeName> time_name(const ColumnName& name) {
  if (name.number) return std::nullopt;
  const auto is_clock = [](std::string_view stem) {
    return holds(names_of_time, stem) || stem.ends_with("_stamp") || stem.ends_with("_timestamp");
  };
  const auto in_brackets = time_unit_named(name.unit);
  if (!name.unit.empty() && !in_brackets) return std::nullopt;
  if (is_clock(name.stem)) return TimeName{in_brackets, name.stem};
  const std::string_view stem = name.stem;
  const std::size_t joint = stem.rfind('_');
  const std::string_view last = joint == stem.npos ? stem : stem.substr(joint + 1);
  const std::string_view clock = joint == stem.npos ? std::string_view{} : stem.substr(0, joint);
  const auto unit = time_unit_named(last);
  // A unit alone is a name of times where nothing else could be meant: no "h", "s", "min".
  if (!unit || (clock.empty() ? last.size() < 2 || last == "min" : !is_clock(clock)))
    return std::nullopt;
  return TimeName{in_brackets ? in_brackets : unit, std::string(clock)};
}

bool is_generic(std::string_view stem) { return holds(generic, stem); }

bool ColumnGroup::is_complete() const noexcept {
  return !twice && field_of.begin()->first <= 1 &&
         field_of.rbegin()->first == field_of.begin()->first + field_of.size() - 1;
}

std::vector<ColumnGroup> column_groups(std::span<const ColumnName> names) {
  std::vector<ColumnGroup> groups;
  for (std::size_t field = 0; field < names.size(); ++field) {
    if (!names[field].number) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const ColumnGroup& one) {
      return one.stem == names[field].stem;
    });
    if (group == groups.end()) group = groups.insert(group, {.stem = names[field].stem});
    if (!group->field_of.emplace(*names[field].number, field).second) group->twice = true;
  }
  return groups;
}

bool means_quantity(std::string_view stem) {
  return quantity_named(stem.substr(0, stem.find('@')), line_quantities).has_value();
}

}  // namespace tactile_net::frames
