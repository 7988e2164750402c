/// @file
/// Taxels as CSV, of an uneven line or skin: a row per taxel. Private.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/scene/units.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// What a file of taxels may hold.
struct TaxelFileKind {
  std::span<const std::string_view> columns{};  ///< their names
  std::span<const Quantity> quantities{};       ///< that taxels may read
  std::size_t least = 1;                        ///< taxels
  std::size_t most = 1;
};

/// A row of such a file.
struct FileTaxel {
  Taxel taxel{};
  std::optional<double> x{};                      ///< of a curved skin's [m]
  std::optional<std::array<double, 3>> normal{};  ///< nx, ny, nz
};

/// Columns in any order; `reads` is a list with blanks between, and the header may give the unit of
/// a length, "y [mm]". Without a column z, y must rise; with a column x the three are a place in
/// space, and nx, ny, nz may be the outward normal there.
///
/// @param missing  depth and reads of every taxel where there is no such column; 0, none: required
/// @param length   the unit of the scene's lengths
/// @throw std::runtime_error  what is wrong, and in which line
[[nodiscard]] std::vector<FileTaxel> read_taxel_file(const std::filesystem::path& path,
                                                     const TaxelFileKind& kind,
                                                     const Taxel& missing, const Unit& length);

/// Whether the header of a CSV has such a column, whatever its unit; false of a file without one.
[[nodiscard]] bool has_column(const std::filesystem::path& path, std::string_view name) noexcept;

}  // namespace tactile_net
