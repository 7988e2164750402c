/// @file
/// An uneven array as CSV: a row per taxel. Private.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "tactile_net/scene/units.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// Columns y, depth and reads in any order, the last a list with blanks between; the header may
/// give the unit of a length, "y [mm]".
///
/// @param missing  depth and reads of every taxel where there is no such column; 0, none: required
/// @param length   the unit of the scene's lengths
/// @throw std::runtime_error  what is wrong, and in which line
[[nodiscard]] std::vector<Taxel> read_taxel_file(const std::filesystem::path& path,
                                                 const Taxel& missing, const Unit& length,
                                                 std::size_t most);

}  // namespace tactile_net
