/// @file
/// Where the unknown tractions are: on the pad's surface, and not at the taxels.
///
/// A contact between two taxels presses on neither. Tractions on a grid of their own, finer than a
/// coarse array and reaching beyond its ends, can say so:
///
///     f(y) = sum_i f_i hat((y - y_i) / spacing),  hat(u) = max(1 - |u|, 0)
///
/// The thesis' tractions, a line load over each taxel, are `SurfaceBasis::taxels`.
///
///     const Surface surface = surface_of(array, {.basis = SurfaceBasis::hats});
///     surface.position(0);                    // [m], almost two depths before the first taxel
///     resultant_of(normal, {}, surface).normal;  // resultant.hpp
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// What a value f_i stands for.
enum class SurfaceBasis {
  taxels,  ///< the line load D f_i at taxel i, D = pitch (thesis 3.4)
  hats,    ///< a traction that is f_i at its place and falls to 0 at its neighbours'
};

/// The name as scenes and JSON spell it: "taxels", "grid".
[[nodiscard]] std::string_view name(SurfaceBasis basis) noexcept;

/// True if taxels lie no further apart than half the least depth: then line loads over them, or a
/// grid as fine as they are, suffice. @pre  the array has a depth
[[nodiscard]] bool is_dense(const SensorArray& array) noexcept;

struct SurfaceOptions {
  SurfaceBasis basis = SurfaceBasis::taxels;
  /// Distance of hats [m], > 0. It is made smaller until every taxel of a regular array, or the
  /// first and the last of an irregular one, lie on places of values. Absent: the pitch of a dense
  /// array, else a quarter of the least depth.
  std::optional<double> spacing{};
  /// How far tractions reach beyond the outermost taxels [m], >= 0, one spacing at least; absent:
  /// two of the least depth.
  std::optional<double> margin{};
};

/// Equally spaced values.
struct Surface {
  SurfaceBasis basis = SurfaceBasis::taxels;
  std::size_t count = 0;   ///< values of each traction, >= 2
  double spacing = 0.0;    ///< [m], > 0: what a value counts for in a sum over the surface
  double centre = 0.0;     ///< y of the middle [m]
  std::size_t margin = 0;  ///< values before the first taxel, and behind the last; the outermost
                           ///< hats end one spacing further
  std::size_t stride = 1;  ///< taxel j lies at value margin + j stride; 0: an irregular array

  /// y of value i [m].
  [[nodiscard]] double position(std::size_t i) const noexcept {
    return centre + centred(i, count) * spacing;
  }
  /// Distance from the middle to the end of a picture of the surface [m].
  [[nodiscard]] double half_width() const noexcept {
    return 0.5 * spacing * static_cast<double>(count);
  }
};

/// y of every value [m].
[[nodiscard]] std::vector<double> positions(const Surface& surface);

/// @throw std::invalid_argument  the array is out of range, spacing is not > 0, margin is not >= 0,
///                               there would be more than `most_values`, or line loads are to lie
///                               over irregular taxels
[[nodiscard]] Surface surface_of(const SensorArray& array, const SurfaceOptions& options = {});

/// The same as a grid of one column.
[[nodiscard]] SurfaceGrid grid_of(const Surface& surface) noexcept;

/// The surface that a line's grid is of. @pre  `grid_of` made it
[[nodiscard]] Surface surface_of(const SurfaceGrid& grid) noexcept;

/// The length that a value stands for over that of a taxel, its spacing over the pitch: what it
/// counts for in the functional (inverse/linear_problem.hpp).
[[nodiscard]] double measure_of(const SensorArray& array, const Surface& surface) noexcept;

/// Options for as many values as taxels, to see what an array hides: line loads over the taxels of
/// a regular array, hats at the mean distance of the taxels of an irregular one.
[[nodiscard]] SurfaceOptions one_value_per_taxel(const SensorArray& array) noexcept;

/// Largest number of values of one traction: matrices of more would not fit a memory.
inline constexpr std::size_t most_values = std::size_t{1} << 22;

}  // namespace tactile_net
