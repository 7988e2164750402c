/// @file
/// How many tractions a skin's scene can be solved for, and how: with dense matrices, or by
/// products alone.
#pragma once

#include <cstddef>

#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net {

/// Readings of a skin that a mixture answers, at most: its windows take a decomposition each.
inline constexpr std::size_t most_mixture_readings = 1024;

/// Tractions beyond `most_skin_tractions`, by products without a matrix: those of about 512 x 512
/// taxels.
inline constexpr std::size_t most_large_skin_tractions = std::size_t{1} << 20;

/// At most for this scene: of taxels on a lattice, with offsets that are known, products by FFT
/// serve where dense matrices do not.
[[nodiscard]] std::size_t most_tractions(const SkinScene& scene);

/// It takes those products. @throw std::invalid_argument  as `grid`
[[nodiscard]] bool is_large(const SkinScene& scene);

}  // namespace tactile_net
