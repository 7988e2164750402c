/// @file
/// What the tables of hands of the plane and in space have in common. Private.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/document.hpp"
#include "scene/references.hpp"
#include "scene/sections.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/option_words.hpp"
#include "tactile_net/scene/space_hand.hpp"

namespace tactile_net {

/// Everything in the file of a hand in space.
void read_hand_tables(Table& root, const References& references, SpaceHand& hand);

inline constexpr Rule share{"must be > 0 and <= 1",
                            [](double x) noexcept { return x > 0.0 && x <= 1.0; }};

/// Text that is a path; relative ones are below the hand's folder.
inline std::filesystem::path path_of(const Value& value, const References& references) {
  const std::string text = value.text().value_or("-");
  if (text.empty())
    value.problem("must name a file", "paths are relative to the hand's folder");
  else if (!references.allow(text))
    value.misfit(
        "must name a file beside the hand's file or below its folder",
        "or else a hand that you did not write could read any of your files; if you wrote it: " +
            option(Option::allow_outside));
  return text;
}

inline std::size_t read_frame(Table& table) {
  const auto value = table.value("frame");
  return value ? static_cast<std::size_t>(value->integer(0, INT64_MAX).value_or(0)) : 0;
}

using Keys = std::initializer_list<const char*>;

/// Keys of the other kinds of contact. @param kinds  of which there are
inline void refuse_others(Table& table, std::string_view kind, Keys keys, std::string_view kinds) {
  const std::string why = "has no place beside " + std::string{kind};
  for (const char* key : keys) table.not_here(key, why, kinds);
}

/// A contact that is a scene, if it is one; then it says nothing else.
///
/// @param others  keys of other kinds, of which there are `kinds`
inline std::optional<FingertipScene> read_scene_contact(Table& table, const References& references,
                                                        Keys others, std::string_view kinds) {
  const auto scene = table.value("scene");
  if (!scene) return std::nullopt;
  FingertipScene tip{.scene = path_of(*scene, references), .readings = {}};
  if (const auto readings = table.value("readings")) {
    tip.readings = path_of(*readings, references);
    tip.frame = read_frame(table);
  } else {
    table.not_here("frame", "has no place without readings", "add readings = \"FILE.csv\"");
  }
  refuse_others(table, "contact.scene", others, kinds);
  return tip;
}

/// What only resultants have.
inline void refuse_without_normal(Table& table, Keys keys) {
  for (const char* key : keys)
    table.not_here(key, "has no place without contact.normal",
                   "a resultant is normal, tangential and center");
}

/// The normal force of a resultant; 1 where it is wrong.
inline double read_push(const Value& normal) {
  const auto value = normal.number(any_number);
  if (value && !(*value > 0.0))
    normal.misfit("must be > 0", "a finger pushes: its normal force points into its pad");
  return value.value_or(1.0);
}

inline double read_variance(Table& table, std::string_view key) {
  const double deviation = number_or(table.value(key), not_negative, 0.0);
  return deviation * deviation;
}

/// @param before  the fingers so far
inline std::string read_name(Table& table, const auto& before) {
  const auto value = table.value("name");
  if (!value) return "finger " + std::to_string(before.size() + 1);
  const std::string name = value->text().value_or("");
  if (name.empty() || name.find_first_of("\r\n") != std::string::npos)
    value->problem("must be a name on one line", "name = \"index\"");
  if (std::any_of(before.begin(), before.end(),
                  [&](const auto& other) { return other.finger.name == name; }))
    value->misfit("must not be another finger's");
  return name;
}

/// One number for each link or joint, where it is known how many there are.
inline std::vector<double> read_for_each(const Value& value, const Rule& rule, std::size_t count,
                                         std::string_view what) {
  const std::vector<double> values = value.numbers(rule).value_or(std::vector<double>{});
  if (!values.empty() && count != 0 && values.size() != count)
    value.problem("must hold one number for each " + std::string(what) + " (" +
                  std::to_string(count) + ' ' + std::string(what) + "s, got " +
                  std::to_string(values.size()) + ')');
  return values;
}

/// What a finger may bear.
///
/// @param count  of its joints; 0: not known
/// @param what   they are called
/// @return  the limits' value
inline std::optional<Value> read_bounds(Table& table, std::size_t count, std::string_view what,
                                        auto& finger) {
  auto limits = table.value("torque_limits");
  if (limits) finger.torque_limits = read_for_each(*limits, positive, count, what);
  if (const auto friction = table.value("friction")) finger.friction = friction->number(positive);
  return limits;
}

/// All fingers. @param read  one, of its table
inline void read_fingers(Table& root, auto& fingers, const auto& read) {
  const auto list = root.required("finger", "one [[finger]] for each finger");
  auto tables = list ? list->tables() : std::nullopt;
  if (!tables) return;
  if (tables->empty()) list->problem("must name at least one finger", "[[finger]]");
  for (Table& table : *tables) fingers.push_back(read(std::move(table)));
}

/// `title` and `units`.
inline void read_heading(Table& root, std::string& title, bool& si) {
  title = read_title(root);
  constexpr std::array<std::string_view, 1> systems = {"SI"};
  if (const auto system = root.value("units"))
    si = system->one_of("system of units", systems).has_value();
}

/// The table [load]: `force` with its `point`, and `torque`.
///
/// @param example  of a point
/// @param vector   reads a force or a point; @param moment  reads a torque
template <class Load>
Load read_load(Table table, std::string_view example, const auto& vector, const auto& moment) {
  Load load;
  const auto force = table.value("force");
  load.force = vector(force);
  const auto point = force ? table.required("point", example) : table.value("point");
  load.point = vector(point);
  load.torque = moment(table.value("torque"));
  table.finish();
  return load;
}

/// `friction_used`, and `friction` of every finger that has none of its own.
inline void read_friction(Table& table, std::optional<double>& used, auto& fingers) {
  if (const auto friction = table.value("friction"))
    if (const auto mu = friction->number(positive))
      for (auto& finger : fingers)
        if (!finger.friction) finger.friction = *mu;
  if (const auto value = table.value("friction_used")) {
    used = value->number(share);
    for (const auto& finger : fingers)
      if (!finger.friction) {
        value->problem("needs the friction of finger '" + finger.finger.name + "'",
                       "friction = 0.6 under [grasp] holds for every finger");
        break;
      }
  }
}

}  // namespace tactile_net
