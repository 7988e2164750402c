/// @file
/// The table [surface], of skins that are curved. Private.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scene/sections.hpp"
#include "scene/taxel_file.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {

/// The one of these enumerators that a text names.
template <typename Enum>
[[nodiscard]] std::optional<Enum> one_named(const Value& value, std::string_view what) {
  std::vector<std::string_view> names;
  for (const auto& row : Enumerators<Enum>::all) names.push_back(row.name);
  const auto index = value.one_of(what, names);
  return index ? std::optional(Enumerators<Enum>::all[*index].value) : std::nullopt;
}

/// Three numbers, such as a place in space; none: a problem, which has been said.
[[nodiscard]] std::optional<SpaceVector> read_three(const Value& value, const Rule& rule,
                                                    const Unit& unit, std::string_view example);

/// The table [surface]; absent: it names a mesh that is not in order, which has been said.
/// @param folder  of the scene's file
[[nodiscard]] std::optional<CurvedSkinOptions> read_surface(Table table,
                                                            const std::filesystem::path& folder,
                                                            const Units& units);

/// The skin of a file's taxels below the surface that a scene states.
///
/// @param axes     `sensor.frame`: along which axes displacements are read
/// @param options  of the surface
/// @throw std::invalid_argument  as `curved_skin`; the extent is that of other units
[[nodiscard]] SkinArray curved_skin_of(std::vector<FileTaxel> rows,
                                       const std::optional<Value>& axes, CurvedSkinOptions options,
                                       const Units& units);

}  // namespace tactile_net
