/// @file
/// The tables of a skin's scene, a function each. Private.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/common_sections.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net {

/// Whether a file is of a skin: its [sensor] has rows or columns, or a file of taxels with a
/// column z.
[[nodiscard]] bool is_skin(const toml::table& scene, const std::filesystem::path& folder);

/// The problem of a skin's scene for those who know lines alone. @pre  it is of a skin
void refuse_skin(const toml::table& scene, Problems& problems);

/// Fills the scene from the whole file; what is wrong goes to the problems that `root` was made
/// with, and then the scene is not complete.
///
/// @param folder  of the scene's file: of the files that it names
void read_skin_sections(Table& root, const std::filesystem::path& folder, SkinScene& scene);

/// The unit of alpha and of the matrix P: that of weighted readings over tractions, squared.
[[nodiscard]] Unit alpha_unit(const Units& units, const SkinScene& scene);

/// The table [sensor]; without taxels where it is wrong.
[[nodiscard]] SkinArray read_skin_sensor(Table table, const std::filesystem::path& folder,
                                         Read& read);

/// The contacts. What was wrong with the sensor counts as harmless.
void read_skin_contacts(std::vector<Table> tables, const Read& read, SkinScene& scene);

/// A list of two numbers, such as a place on the surface.
[[nodiscard]] std::optional<std::array<double, 2>> read_two(const Value& value, const Rule& rule,
                                                            const Unit& unit,
                                                            std::string_view example);

}  // namespace tactile_net
