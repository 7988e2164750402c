/// @file
/// What is the same of scenes of a line and of a skin. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/scene/clipped_taxels.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

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

/// @param offsets  per channel; empty: none
[[nodiscard]] remark::OffsetsFound offsets_found(std::span<const double> offsets,
                                                 const auto& scene) {
  remark::OffsetsFound found{.units = scene.units};
  if (offsets.empty()) return found;
  for (const auto& channel : channels(scene.sensor)) {
    const QuantityKind kind = traits(channel.quantity).kind;
    found.channels.push_back({.channel = channel.name,
                              .value = offsets[found.channels.size()],
                              .dimension = dimension_of(kind)});
  }
  return found;
}

/// By the noise, the friction limit and the stiffness that the scene states: no stress above
/// Young's modulus, no strain above 1, no displacement beyond the taxel's depth.
[[nodiscard]] DataLimits limits_of(const auto& problem) {
  const auto& scene = problem.scene();
  const double modulus = scene.material.youngs_modulus;
  DataLimits limits{.noise_rms = problem.stated_noise(),
                    .friction_limit = scene.reconstruct.friction_limit,
                    .largest_traction = modulus};
  for (const Site& site : sites(scene.sensor)) {
    const QuantityKind kind = traits(site.quantity).kind;
    limits.largest_readings.push_back(kind == QuantityKind::strain         ? 1.0
                                      : kind == QuantityKind::displacement ? site.depth
                                                                           : modulus);
  }
  return limits;
}

/// Tractions that may not pull cannot show that a contact does: it does where what no contact
/// explains is explained by tractions without the constraints.
///
/// @param left  the norm of the weighted residual of those
/// @param rows  independent ones
inline void find_pulls(DataVerdict& data, double left, std::size_t rows) {
  if (left <= data.residual_limit * std::sqrt(static_cast<double>(rows)))
    std::replace(data.doubts.begin(), data.doubts.end(), DataDoubt::misfit, DataDoubt::pulls);
}

/// @param data  not consistent
[[nodiscard]] remark::DataDoubted with_names(const DataVerdict& data, const auto& scene) {
  return {.data = data,
          .taxel = data.taxel ? taxel_name(scene.sensor, *data.taxel) : std::string{},
          .offsets = offsets_found(data.offset, scene)};
}

[[nodiscard]] std::vector<std::string> taxel_names(const auto& array,
                                                   std::span<const std::size_t> taxels) {
  std::vector<std::string> names;
  for (const std::size_t taxel : taxels) names.push_back(taxel_name(array, taxel));
  return names;
}

/// The frame's taxels at the end of their range. Whether an answer does without them is the
/// caller's to say.
[[nodiscard]] remark::Clipped clipped_in(const auto& scene, std::span<const Site> sites,
                                         std::span<const double> readings) {
  ClippedTaxels found = clipped_taxels(scene, sites, readings);
  std::vector<std::string> names = taxel_names(scene.sensor, found.taxels);
  return {.taxels = std::move(found.taxels),
          .names = std::move(names),
          .range_known = found.range_known};
}

}  // namespace tactile_net::lab
