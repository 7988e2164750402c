/// @file
/// The stress inside the pad under tractions that were found: what a picture of the pad shows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// How deep a picture of the pad reaches [m]: to a layer's base, or on a half plane to twice the
/// deepest taxel.
[[nodiscard]] double interior_depth(const Scene& scene);

/// stress_x on rows of points below the taxels' places, of a unit traction on one taxel's strip.
struct InteriorKernels {
  std::vector<double> depths{};  ///< of the rows [m]
  std::size_t lags = 0;          ///< 2 count - 1: from one end of the array to the other and back
  /// Row by row: lag - (count - 1) is the place's index minus the loaded taxel's.
  std::vector<double> of_normal{};
  std::vector<double> of_tangential{};  ///< empty: not asked for
};

/// A strip is one pitch wide, its traction uniform. Rows reach down to `interior_depth`.
[[nodiscard]] InteriorKernels interior_kernels(const Scene& scene, std::size_t rows,
                                               bool tangential);

/// stress_x inside the pad [Pa], row by row, one value per taxel's place, under tractions of one
/// value per taxel. O(rows count^2).
/// @param tangential  empty: none
[[nodiscard]] std::vector<double> interior_stress(const InteriorKernels& kernels,
                                                  std::span<const double> normal,
                                                  std::span<const double> tangential);

}  // namespace tactile_net::lab
