#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scene/sections.hpp"
#include "tactile_net/scene/nearest.hpp"

namespace tactile_net {
namespace {

struct UnitKey {
  std::string_view name;
  Unit Units::*member;
  Dimension dimension;
  std::string_view what;
};

constexpr UnitKey unit_keys[] = {
    {"length", &Units::length, Dimension::length, "unit of length"},
    {"modulus", &Units::modulus, Dimension::stress, "unit of stress"},
    {"stress", &Units::stress, Dimension::stress, "unit of stress"},
};

constexpr UnitKey force_key(Dimension force) {
  return {"force", &Units::force, force,
          force == Dimension::force ? "unit of force per unit of depth" : "unit of force"};
}

std::optional<Unit> read_unit(const Value& value, const UnitKey& key) {
  const auto units = units_of(key.dimension);
  std::vector<std::string_view> names;
  for (const Unit& unit : units) names.push_back(unit.name);
  const auto text = value.text();
  if (!text) return std::nullopt;
  if (const auto unit = unit_named(key.dimension, *text)) return unit;
  const std::string_view near = nearest(*text, names);
  const bool is_force_alone =
      key.dimension == Dimension::stress && dimension_named(*text) == Dimension::point_force;
  value.problem(
      "names an unknown " + std::string{key.what} + ' ' + in_quotes(*text),
      is_force_alone
          ? "readings are stresses: the area of a taxel makes newtons into them. Under "
            "[calibration], "
            "gain = 1 / area: 1 N on 16 mm^2 is 62.5 kPa; the unit of a stress is one of " +
                listed(names)
          : (near.empty() ? "" : "did you mean " + in_quotes(near) + "? ") + "one of " +
                listed(names));
  return std::nullopt;
}

}  // namespace

Units read_units(Table table, Dimension force) {
  Units units;
  units.force = {.name = si_unit(force)};
  const auto read = [&](const UnitKey& key) {
    if (const auto value = table.value(key.name))
      if (const auto unit = read_unit(*value, key)) units.*key.member = *unit;
  };
  for (const UnitKey& key : unit_keys) read(key);
  read(force_key(force));
  table.finish();
  return units;
}

}  // namespace tactile_net
