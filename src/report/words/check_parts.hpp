/// @file
/// Private. Taxels and readings of a recording's check in words, of a line and of a skin.
#pragma once

#include <cstddef>
#include <string>

#include "report/load_dimension.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::report {

/// How [dead_taxels] names a taxel.
[[nodiscard]] inline std::string index_of(const Scene& scene, std::size_t taxel) {
  return taxel_name(scene.sensor, taxel);
}
[[nodiscard]] inline std::string index_of(const SkinScene& scene, std::size_t taxel) {
  return '"' + taxel_name(scene.sensor, taxel) + '"';
}
[[nodiscard]] inline std::size_t taxels_of(const Scene& scene) { return scene.sensor.count; }
[[nodiscard]] inline std::size_t taxels_of(const SkinScene& scene) {
  return taxel_count(scene.sensor);
}

[[nodiscard]] QuantityKind kind_of(const auto& scene, std::size_t channel) {
  return traits(channels(scene.sensor)[channel].quantity).kind;
}

/// A reading, with its unit where the scene states units.
[[nodiscard]] std::string reading(const auto& scene, std::size_t channel, double value) {
  const QuantityKind kind = kind_of(scene, channel);
  return kind == QuantityKind::strain ? brief(value)
                                      : in_unit(scene.units, dimension_of(kind), value);
}

/// The line of [noise] that states what was estimated; every quantity where the
/// scene names each.
[[nodiscard]] std::string noise_line(const auto& scene, std::size_t channel, double rms) {
  if (scene.units) rms = unit_of(*scene.units, kind_of(scene, channel)).from_si(rms);
  const std::string number = brief(rms);
  if (channel_count(scene.sensor) == 1) return "under [noise], rms = " + number;
  return "under [noise], rms = { " + std::string(name(channels(scene.sensor)[channel].quantity)) +
         " = " + number + ", ... }";
}

}  // namespace tactile_net::report
