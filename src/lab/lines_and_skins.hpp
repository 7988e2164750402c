/// @file
/// What is the same of scenes of a line and of a skin. Private.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/lab/remark.hpp"

namespace tactile_net::lab {

[[nodiscard]] inline bool any_contact_moves(const auto& scene) {
  return std::any_of(scene.trajectories.begin(), scene.trajectories.end(),
                     [](const auto& trajectory) { return !trajectory.empty(); });
}

/// @param options  of [reconstruct]
[[nodiscard]] inline std::optional<Constraints> stated_constraints(const auto& options) {
  if (!options.nonnegative && !options.friction_limit) return std::nullopt;
  return Constraints{.nonnegative = true, .friction_limit = options.friction_limit};
}

/// @param offsets  per channel
[[nodiscard]] inline remark::OffsetsFound offsets_found(std::span<const double> offsets,
                                                        const auto& array) {
  remark::OffsetsFound found;
  for (const auto& channel : channels(array))
    found.channels.emplace_back(channel.name, offsets[found.channels.size()]);
  return found;
}

}  // namespace tactile_net::lab
