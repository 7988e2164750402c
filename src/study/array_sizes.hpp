/// @file
/// Private. The same skin with more or fewer taxels.
#pragma once

#include <cstddef>
#include <optional>

#include "tactile_net/realtime/estimator_plan.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::study {

struct ArraySize {
  std::size_t rows = 0;
  std::size_t columns = 0;
};

/// About `side` taxels along the longer side, in the scene's own proportions.
/// @pre  the skin is even
[[nodiscard]] ArraySize size_of(const SkinScene& scene, std::size_t side);

/// The scene with so many taxels, all alive. @param spacing  of its cells; absent: as the scene has
/// them
[[nodiscard]] SkinScene with_size(SkinScene scene, const ArraySize& size,
                                  std::optional<double> spacing = {});

/// What a frame of an array of another size costs follows from the shapes of its factors alone: a
/// plan with those shapes, and numbers of no meaning in them.
///
/// @param plan    dense, or of reflections, of an array whose sides are in the same proportions;
/// its
///                classes and blocks are taken
/// @param taxels  of the other
/// @param cells   of the other
[[nodiscard]] EstimatorPlan shaped_plan(EstimatorPlan plan, const ArraySize& taxels,
                                        const SurfaceGrid& cells);

/// By the four classes of the reflections alone.
[[nodiscard]] EstimatorPlan without_exchange(EstimatorPlan plan);

}  // namespace tactile_net::study
