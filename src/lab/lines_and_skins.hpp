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
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/scene/clipped_taxels.hpp"
#include "tactile_net/scene/sensor_effects.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net::lab {

[[nodiscard]] inline bool any_contact_moves(const auto& scene) {
  return std::any_of(scene.trajectories.begin(), scene.trajectories.end(),
                     [](const auto& trajectory) { return !trajectory.empty(); });
}

/// The rms of the noise that the scene states of a quantity's readings, with what a converter's
/// steps add to it; 0: it is not stated.
[[nodiscard]] inline double known_noise(const SensorEffects& effects, Quantity quantity) {
  const auto stated = effects.noise->rms.find(quantity);
  const double rms = stated == effects.noise->rms.end() ? 0.0 : stated->second;
  if (!(rms > 0.0) || !effects.quantization) return rms;
  return std::hypot(rms, step(*effects.quantization, quantity) / std::sqrt(12.0));
}

/// That of each channel, by which its readings are weighted; empty: they are not.
[[nodiscard]] std::vector<double> weights_of_channels(const auto& scene) {
  std::vector<double> rms;
  if (scene.noise && scene.noise->weights_rows)
    for (const Channel& channel : channels(scene.sensor))
      rms.push_back(known_noise(scene, channel.quantity));
  return rms;
}

/// That of one weighted reading; absent: it is not known, or there is none.
[[nodiscard]] std::optional<double> noise_of_readings(const auto& scene) {
  if (!scene.noise) return std::nullopt;
  if (scene.noise->weights_rows) return 1.0;
  double squares = 0.0;
  const std::vector<Channel> all = channels(scene.sensor);
  for (const Channel& channel : all)
    squares += std::pow(known_noise(scene, channel.quantity), 2) / static_cast<double>(all.size());
  return squares > 0.0 ? std::optional(std::sqrt(squares)) : std::nullopt;
}

/// What the pad's formula may be off by; 0: that is not stated.
[[nodiscard]] inline double model_share(const SensorEffects& effects) {
  return effects.noise ? effects.noise->model_share : 0.0;
}

/// Beside that what a ball as curved as the mean leaves out of a surface whose two curvatures
/// differ: about .3 of their difference times the thickness.
[[nodiscard]] inline double model_share(const SkinScene& scene) {
  const double stated = model_share(static_cast<const SensorEffects&>(scene));
  if (!scene.sensor.curved || scene.sensor.curved->given || !scene.material.layer) return stated;
  double difference = 0.0;
  for (const SurfacePlace& place : scene.sensor.curved->above)
    difference += place.curvature_difference;
  difference /= static_cast<double>(scene.sensor.curved->above.size());
  return std::hypot(stated, 0.3 * difference * scene.material.layer->thickness);
}

/// What a mixture takes of the noise. @pre  the scene states it
[[nodiscard]] LoadNoise load_noise(const auto& scene) {
  return {.rms = noise_of_readings(scene),
          .degrees = scene.noise->degrees,
          .model_share = model_share(scene)};
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
/// Young's modulus, no strain above 1, no displacement beyond the taxel's depth or, where that is
/// more, the rest of a layer below it.
[[nodiscard]] DataLimits limits_of(const auto& problem) {
  const auto& scene = problem.scene();
  const double modulus = scene.material.youngs_modulus;
  DataLimits limits{.noise_rms = problem.stated_noise(),
                    .friction_limit = scene.reconstruct.friction_limit,
                    .largest_traction = modulus};
  const double thickness = scene.material.layer ? scene.material.layer->thickness : 0.0;
  for (const Site& site : sites(scene.sensor)) {
    const double reach = std::max(site.depth, thickness - site.depth);
    const QuantityKind kind = traits(site.quantity).kind;
    limits.largest_readings.push_back(kind == QuantityKind::strain         ? 1.0
                                      : kind == QuantityKind::displacement ? reach
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

/// What a line's problem, made ready for frames, takes in memory, about: K, its decomposition, the
/// method's matrix, a covariance.
[[nodiscard]] inline std::size_t bytes_of_frames(const SceneProblem& problem) {
  constexpr std::size_t matrices = 8;
  constexpr std::size_t numbers_of_rules = 1000;  // AlphaTables, per traction
  const std::size_t n = problem.tractions();
  return sizeof(double) * (matrices * (problem.readings() + n) + numbers_of_rules) * n;
}

/// All of both, each once.
[[nodiscard]] inline std::vector<std::size_t> rising(std::vector<std::size_t> taxels,
                                                     std::span<const std::size_t> more) {
  taxels.insert(taxels.end(), more.begin(), more.end());
  std::sort(taxels.begin(), taxels.end());
  taxels.erase(std::unique(taxels.begin(), taxels.end()), taxels.end());
  return taxels;
}

/// Whether the other taxels measure anything where these are dead.
[[nodiscard]] inline bool measures_without(const SceneProblem& problem,
                                           const std::vector<std::size_t>& taxels) {
  LineProblemOptions options = problem.options();
  options.dead_taxels = taxels;
  return is_measured(problem.scene().sensor, options);
}
[[nodiscard]] inline bool measures_without(const SkinSceneProblem& problem,
                                           const std::vector<std::size_t>& taxels) {
  const SkinScene& scene = problem.scene();
  return is_measured(scene.sensor, taxels, scene.reconstruct.offset);
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
