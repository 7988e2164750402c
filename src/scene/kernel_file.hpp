/// @file
/// The kernel of a curved pad from a file, by finite elements or whatever else: an archive of
/// arrays as numpy.savez writes it. Private.
#pragma once

#include <filesystem>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {

/// The arrays K (readings x 3 cells, all normal tractions first), vertices (m x 3, metres), cells
/// (k x 3 or k x 4, counterclockwise from outside, triangles filled up by -1) and readings (names);
/// and where they are there frames (k x 3 x 3), units, frame, thickness, youngs_modulus,
/// poisson_ratio. Readings are brought into the skin's order; of another Young's modulus
/// displacements and strains are scaled.
///
/// @param skin  curved
/// @throw std::runtime_error  what is wrong with the file, and what to do
[[nodiscard]] GivenKernel read_kernel_file(const std::filesystem::path& path, const SkinArray& skin,
                                           const Material& material);

}  // namespace tactile_net
