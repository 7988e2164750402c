/// @file
/// What hands of the plane and hands in space have in common in their files. Private.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/references.hpp"
#include "scene/table.hpp"
#include "tactile_net/scene/hand.hpp"

namespace tactile_net::hand_parts {

inline constexpr Rule share{"must be > 0 and <= 1",
                            [](double x) noexcept { return x > 0.0 && x <= 1.0; }};

/// Text that is a path; relative ones are below the hand's folder.
[[nodiscard]] std::filesystem::path path_of(const Value& value, const References& references);

[[nodiscard]] std::size_t read_frame(Table& table);

using Keys = std::initializer_list<const char*>;

/// Keys of the other kinds of contact. @param kinds  of which there are
void refuse_others(Table& table, std::string_view kind, Keys keys, std::string_view kinds);

/// contact = { scene, readings, frame }
[[nodiscard]] FingertipScene read_fingertip_scene(Table& table, const Value& scene,
                                                  const References& references);

/// @param before  the names of the fingers so far
[[nodiscard]] std::string read_name(Table& table, const std::vector<std::string>& before);

/// One number for each link or joint, where it is known how many there are.
[[nodiscard]] std::vector<double> read_for_each(const Value& value, const Rule& rule,
                                                std::size_t count, std::string_view what);

/// `title` and `units`.
void read_heading(Table& root, std::string& title, bool& si);

/// The table [load]: `force` with its `point`, and `torque`.
///
/// @param example  of a point
/// @param vector   reads a force or a point; @param moment  reads a torque
template <class Load>
[[nodiscard]] Load read_load(Table table, std::string_view example, const auto& vector,
                             const auto& moment) {
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
void read_friction(Table& table, std::optional<double>& used, auto& fingers) {
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

}  // namespace tactile_net::hand_parts
