/// @file
/// Private. Tractions over a skin as a map, seen from outside: y to the right, z downwards, x away
/// from who looks, which is right-handed. Cells are squares of one colour, for nothing lies between
/// them that was solved for; drags are arrows.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::pages {

/// Rectangles of one size, row after row along y, as cells of a `SurfaceGrid` or taxels of a
/// lattice.
struct MapGrid {
  std::size_t rows = 1;     ///< along y
  std::size_t columns = 1;  ///< along z
  double spacing_y = 1.0;   ///< [m]
  double spacing_z = 1.0;
  double first_y = 0.0;  ///< the first cell's middle [m]
  double first_z = 0.0;

  static constexpr double width = 600.0;  ///< of a map, in its own units

  [[nodiscard]] double scale() const noexcept {
    return width / (spacing_y * static_cast<double>(rows));
  }
  [[nodiscard]] double height() const noexcept {
    return scale() * spacing_z * static_cast<double>(columns);
  }
  /// Where a place of the surface lies in the map.
  [[nodiscard]] double across(double y) const noexcept {
    return scale() * (y - first_y + 0.5 * spacing_y);
  }
  [[nodiscard]] double down(double z) const noexcept {
    return scale() * (z - first_z + 0.5 * spacing_z);
  }
};

[[nodiscard]] MapGrid map_grid(const SurfaceGrid& grid);

/// What colours mean: signed_values are white at 0, blue above, red below; sizes purple from 0 on.
enum class MapColours { signed_values, sizes };

/// Values as an <image>, for light and for dark. @param most  the size of full colour, > 0
[[nodiscard]] std::string map_image(const MapGrid& grid, std::span<const double> values,
                                    double most, MapColours colours);

/// Arrows of drags; where cells are many, each the mean of a block of them.
///
/// @param most  the drag whose arrow is as long as arrows are apart, > 0
[[nodiscard]] std::string map_arrows(const MapGrid& grid, std::span<const double> along_y,
                                     std::span<const double> along_z, double most);

/// Around cells for which `inside` is true.
[[nodiscard]] std::string map_outline(const MapGrid& grid, const std::vector<bool>& inside);

/// Where taxels are: a dot each if there are any dots, of dead ones a cross.
/// @param dead  their numbers
[[nodiscard]] std::string map_taxels(const MapGrid& grid, const SkinArray& skin,
                                     std::span<const std::size_t> dead);

/// The map with its numbers around it.
///
/// @param inside  SVG, as of the functions above
[[nodiscard]] std::string map_picture(const std::optional<Units>& units, const MapGrid& grid,
                                      std::string_view title, std::string_view label,
                                      const std::string& inside);

/// What stands around a map: at the ends of its two axes, and what runs along them.
struct MapEnds {
  std::string left{}, across{}, right{};
  std::string top{}, down{}, bottom{};
};

/// The same with other words than places around it.
[[nodiscard]] std::string map_picture(const MapGrid& grid, const MapEnds& ends,
                                      std::string_view title, std::string_view label,
                                      const std::string& inside);

/// The colours' numbers, from 0 or -`most` to `most`.
///
/// @param negative  values below 0 are to be seen
/// @param arrow     what the longest arrow stands for, in words; empty: none
[[nodiscard]] std::string colour_bar(MapColours colours, const ScaledUnit& unit, double most,
                                     bool negative, const std::string& arrow);

}  // namespace tactile_net::pages
