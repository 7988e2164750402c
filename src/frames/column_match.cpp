#include "frames/column_match.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "frames/column_names.hpp"
#include "frames/column_places.hpp"
#include "frames/header_units.hpp"
#include "tactile_net/frames/frame_clock.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::frames {
namespace {

using Names = std::span<const std::string>;

std::string quoted(const std::string& name) {
  constexpr std::size_t most = 40;
  return "'" + (name.size() > most ? name.substr(0, most - 3) + "..." : name) + "'";
}

std::string first_to_last(Names names) {
  return names.size() == 1 ? names.front() : names.front() + " to " + names.back();
}

/// "4 columns: 't', 'a', 'b', 'c'", of many the first three and the last.
std::string found(Names header) {
  std::string text =
      std::to_string(header.size()) + (header.size() == 1 ? " column: " : " columns: ");
  const std::size_t shown = header.size() <= 5 ? header.size() : 3;
  for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + quoted(header[i]);
  return shown == header.size() ? text : text + ", ..., " + quoted(header.back());
}

/// What to do about a file whose columns are not understood.
std::string offer(const std::string& what_was_found, std::size_t fields,
                  const WantedColumns& wanted) {
  const std::size_t count = wanted.names.size();
  std::string text = what_was_found + "; " + std::to_string(count) + " are read here, " +
                     first_to_last(wanted.names);
  if (fields == 1) return text + "; fields are separated by , ; a tab or blanks";
  if (fields < wanted.names.size()) {
    if (wanted.rows > 0)
      text +=
          "; a frame is one line, row of taxels after row: where a line holds one row of the "
          "matrix, join the " +
          std::to_string(wanted.rows) + " lines of a frame";
    return text;
  }
  const std::size_t others = fields - count;
  return text + "; if columns " + std::to_string(others + 1) + " to " +
         std::to_string(others + count) + " are these, in this order: " +
         option(Option::columns, (others > 0 ? "t=1," : "") + places_after(others, count)) +
         (others > 0
              ? " (t=1: the first holds times; t=1+2: seconds, and nanoseconds in the second)"
              : "");
}

class Matching {
 public:
  Matching(Names header, const WantedColumns& wanted)
      : header_(header), wanted_(wanted.names), given_(wanted) {
    match_.target.assign(header.size(), ColumnMatch::ignored_field);
    for (const std::string& name : header) names_.push_back(column_name(name));
    for (const std::string& name : wanted_) index_.emplace(name, index_.size());
    taken_.resize(wanted_.size());
    one_channel_ = wanted.taxels == wanted_.size() && wanted.taxels > 0;
    count_from_zero(wanted.taxels);
  }

  void by_exact_name() {
    for (std::size_t field = 0; field < header_.size(); ++field) {
      const auto wanted = index_.find(header_[field]);
      if (wanted == index_.end() || counted_from_one_[field]) continue;
      if (taken_[wanted->second])
        throw NoMatch("column '" + header_[field] + "' stands twice", {}, field);
      take(field, wanted->second);
    }
  }

  void by_other_spelling() {
    std::map<std::size_t, std::size_t> field_of;  // by the index of what it would be
    for (std::size_t field = 0; field < header_.size(); ++field) {
      if (match_.target[field] >= 0) continue;
      const auto wanted = index_.find(names_[field].plain());
      if (wanted == index_.end() || taken_[wanted->second]) continue;
      const auto [other, is_new] = field_of.emplace(wanted->second, field);
      if (!is_new)
        throw NoMatch("columns " + quoted(header_[other->second]) + " and " +
                          quoted(header_[field]) + " may both be " + std::string(wanted->first),
                      "say which by " + option(Option::columns), field);
    }
    if (field_of.empty()) return;
    for (const auto& [wanted, field] : field_of) take(field, wanted);
    const auto& [wanted, field] = *field_of.begin();
    match_.notes.push_back(std::to_string(field_of.size()) +
                           " columns are read by another spelling"
                           ", " +
                           quoted(header_[field]) + " as " + wanted_[wanted]);
  }

  /// "taxel_0", ..., in any order: as many as are wanted, numbered from 0 or 1 without a gap.
  void by_number() {
    if (std::find(taken_.begin(), taken_.end(), true) != taken_.end()) return;
    std::map<std::size_t, std::size_t> field_of;  // by number
    for (std::size_t field = 0; field < header_.size(); ++field)
      if (names_[field].number && is_generic(names_[field].stem))
        if (!field_of.emplace(*names_[field].number, field).second) return;
    if (field_of.size() != wanted_.size()) return;
    const std::size_t first = field_of.begin()->first;
    if (first > 1 || field_of.rbegin()->first != first + wanted_.size() - 1) return;
    for (const auto& [number, field] : field_of) take(field, number - first);
    match_.notes.push_back("columns " + quoted(header_[field_of.begin()->second]) + " to " +
                           quoted(header_[field_of.rbegin()->second]) + " are taken for " +
                           first_to_last(wanted_));
  }

  /// "Druck_1", "Druck_2", ...: any name that as many columns share as there are taxels, if it is
  /// the only such one and no other quantity's.
  void by_common_name() {
    if (!one_channel_ || std::find(taken_.begin(), taken_.end(), true) != taken_.end()) return;
    const ColumnGroup* only = nullptr;
    const std::vector<ColumnGroup> groups = column_groups(names_);
    for (const ColumnGroup& group : groups) {
      if (!group.is_complete() || group.field_of.size() != wanted_.size() ||
          means_quantity(group.stem))
        continue;
      if (only != nullptr) return;
      only = &group;
    }
    if (only == nullptr) return;
    std::size_t next = 0;
    for (const auto& [number, field] : only->field_of) take(field, next++);
    match_.notes.push_back("columns " + quoted(header_[only->field_of.begin()->second]) + " to " +
                           quoted(header_[only->field_of.rbegin()->second]) + " are taken for " +
                           first_to_last(wanted_));
  }

  void by_places(const std::string& places) {
    const auto place_of = [&](std::string_view name) -> std::optional<std::size_t> {
      const auto exact = std::find(header_.begin(), header_.end(), name);
      if (exact != header_.end()) return static_cast<std::size_t>(exact - header_.begin());
      const std::string plain = column_name(name).plain();
      for (std::size_t field = 0; field < names_.size(); ++field)
        if (names_[field].plain() == plain) return field;
      return std::nullopt;
    };
    const ColumnPlaces found_at = column_places(places, header_.size(), wanted_.size(), place_of);
    for (std::size_t i = 0; i < wanted_.size(); ++i) take(found_at.readings[i], i);
    if (found_at.time) take_time(*found_at.time);
    if (found_at.nanoseconds) take_nanoseconds(*found_at.nanoseconds);
  }

  /// A column "t" before others that mean times, and the first of those.
  void find_time() {
    if (match_.has_time) return;
    const auto is_free = [&](std::size_t field) {
      return match_.target[field] == ColumnMatch::ignored_field;
    };
    std::optional<std::size_t> best;
    for (std::size_t field = 0; field < header_.size(); ++field) {
      if (!is_free(field) || !time_name(names_[field])) continue;
      if (header_[field] == "t" || !best) best = field;
      if (header_[field] == "t") break;
    }
    if (!best) return;
    const TimeName found = *time_name(names_[*best]);
    // The other part of it: ROS writes seconds and nanoseconds apart.
    for (std::size_t field = 0; found.unit && field < header_.size(); ++field) {
      if (!is_free(field) || field == *best) continue;
      const auto other = time_name(names_[field]);
      if (!other || !other->unit || other->clock != found.clock) continue;
      const bool begins = found.unit->is_si() && other->unit->name == "ns";
      if (!begins && !(other->unit->is_si() && found.unit->name == "ns")) continue;
      take_time(begins ? *best : field);
      take_nanoseconds(begins ? field : *best);
      return;
    }
    take_time(*best);
    if (match_.time_unit && !match_.time_unit->is_si())
      match_.notes.push_back("times of " + quoted(header_[*best]) + " are in " +
                             std::string(match_.time_unit->name) +
                             ": they become seconds; files of tractions copy them unchanged");
  }

  /// Units behind the names of what is read.
  void read_units() {
    std::vector<std::string> said;
    for (std::size_t field = 0; field < header_.size(); ++field) {
      const std::string& unit = names_[field].unit;
      if (match_.target[field] < 0 || unit.empty()) continue;
      const auto wanted = static_cast<std::size_t>(match_.target[field]);
      const bool is_new = std::find(said.begin(), said.end(), unit) == said.end();
      if (is_new) said.push_back(unit);
      if (given_.units.empty()) {
        if (is_new) say_unit(unit, "the scene states no [units] to compare it with");
        continue;
      }
      const HeaderUnit found = header_unit(unit, given_.units[wanted]);
      if (!found.problem.empty())
        throw NoMatch(found.problem + " (column " + quoted(header_[field]) + ")", found.what_to_do,
                      field);
      if (found.factor) {
        match_.factors.resize(wanted_.size());
        match_.factors[wanted] = *found.factor;
        if (is_new)
          match_.notes.push_back("the header gives the unit [" + unit +
                                 "]: values are converted to " +
                                 std::string(given_.units[wanted].unit.name) + ", the scene's");
      } else if (!found.understood && is_new) {
        say_unit(unit, "it is not a known unit");
      }
    }
  }

  [[nodiscard]] ColumnMatch finished() {
    const auto missing = std::count(taken_.begin(), taken_.end(), false);
    if (missing > 0) {
      const auto first =
          static_cast<std::size_t>(std::find(taken_.begin(), taken_.end(), false) - taken_.begin());
      throw NoMatch("column '" + wanted_[first] + "' is missing" +
                        (missing > 1 ? " and " + std::to_string(missing - 1) + " more" : ""),
                    offer("the header has " + found(header_), header_.size(), given_));
    }
    read_units();
    for (std::size_t field = 0; field < header_.size(); ++field)
      if (match_.target[field] == ColumnMatch::ignored_field)
        match_.ignored.push_back(header_[field]);
    return std::move(match_);
  }

 private:
  /// A quantity whose taxels are numbered from 1 in the file is another spelling of it.
  void count_from_zero(std::size_t taxels) {
    counted_from_one_.resize(header_.size());
    for (const ColumnGroup& group : column_groups(names_)) {
      if (!means_quantity(group.stem) || !group.is_complete() ||
          group.field_of.begin()->first != 1 || group.field_of.size() != taxels)
        continue;
      for (const auto& [number, field] : group.field_of) {
        counted_from_one_[field] = true;
        names_[field].number = number - 1;
      }
    }
  }

  void take(std::size_t field, std::size_t wanted) {
    match_.target[field] = static_cast<std::ptrdiff_t>(wanted);
    taken_[wanted] = true;
  }
  void take_time(std::size_t field) {
    match_.target[field] = ColumnMatch::time_field;
    match_.has_time = true;
    if (const auto found = time_name(names_[field])) match_.time_unit = found->unit;
  }
  void say_unit(const std::string& unit, const std::string& why) {
    match_.notes.push_back("the header gives the unit [" + unit.substr(0, 20) +
                           "]: values are not converted, and count as in the scene's unit; " + why);
  }
  void take_nanoseconds(std::size_t field) {
    match_.target[field] = ColumnMatch::nanoseconds_field;
    match_.time_unit = time_unit_named("s");
  }

  Names header_;
  Names wanted_;
  const WantedColumns& given_;
  std::vector<ColumnName> names_;
  std::map<std::string_view, std::size_t, std::less<>> index_;
  std::vector<bool> taken_;
  std::vector<bool> counted_from_one_;  // per field
  bool one_channel_ = false;
  ColumnMatch match_;
};

}  // namespace

ColumnMatch match_columns(Names header, const WantedColumns& wanted) {
  Matching matching(header, wanted);
  if (!wanted.places.empty()) {
    matching.by_places(wanted.places);
  } else {
    matching.by_exact_name();
    matching.by_other_spelling();
    matching.by_number();
    matching.by_common_name();
  }
  matching.find_time();
  return matching.finished();
}

ColumnMatch match_unnamed(std::size_t fields, const WantedColumns& wanted) {
  ColumnMatch match;
  match.target.assign(fields, ColumnMatch::ignored_field);
  ColumnPlaces places;
  if (!wanted.places.empty()) {
    places = column_places(wanted.places, fields, wanted.names.size(),
                           [](std::string_view) { return std::nullopt; });
  } else if (fields == wanted.names.size()) {
    for (std::size_t i = 0; i < fields; ++i) places.readings.push_back(i);
    match.notes.push_back("there is no header: the " + std::to_string(fields) +
                          " columns are taken for " + first_to_last(wanted.names));
  } else {
    throw NoMatch("there is no header: the first line holds numbers",
                  offer("it has " + std::to_string(fields) + " columns", fields, wanted));
  }
  for (std::size_t i = 0; i < places.readings.size(); ++i)
    match.target[places.readings[i]] = static_cast<std::ptrdiff_t>(i);
  if (places.time) match.target[*places.time] = ColumnMatch::time_field;
  if (places.nanoseconds) {
    match.target[*places.nanoseconds] = ColumnMatch::nanoseconds_field;
    match.time_unit = time_unit_named("s");
  }
  match.has_time = places.time.has_value();
  for (std::size_t field = 0; field < fields; ++field)
    if (match.target[field] == ColumnMatch::ignored_field)
      match.ignored.push_back("column " + std::to_string(field + 1));
  return match;
}

}  // namespace tactile_net::frames
