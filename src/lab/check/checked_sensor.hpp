/// @file
/// What a recording's check asks of its scene, of a line or of a skin. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

struct CheckedSensor {
  SignalLayout layout{};
  std::vector<std::string> names{};             ///< of the channels
  std::vector<std::optional<double>> stated{};  ///< noise of each channel, by the scene
  /// What channels' readings are multiplied by to have one unit: 1 over the
  /// noise where the scene states it for each quantity, else 1.
  std::vector<double> weights{};
  std::optional<double> noise{};  ///< of one weighted reading, by the scene
  std::vector<std::size_t> dead_taxels{};
  bool has_columns = false;  ///< taxels lie along z too
  /// Pressure shows by itself: in a quantity that is the same on all sides of a press, or by being
  /// all that is looked for. Others, as displacements in the plane, know it by its slopes.
  bool reads_pressure = false;
  /// From end to end it is twice as long as its taxels are deep: no narrow contact reads the same
  /// everywhere.
  bool is_wide = false;
  bool offset = false;  ///< each channel has a constant that is not known
  double youngs_modulus = 0.0;
  std::vector<double> apart{};  ///< how far each two of the layout's neighbours are [m]
  /// Readings of a channel around one: what a load over it shows in.
  struct Around {
    std::vector<std::size_t> beside{};  ///< all of which feel it; none: taxels are too far apart
    std::vector<std::size_t> behind{};  ///< of which one does, if it is no ripple
  };
  std::vector<Around> around{};  ///< of each reading
};

[[nodiscard]] CheckedSensor checked_sensor(const Scene& scene);
[[nodiscard]] CheckedSensor checked_sensor(const SkinScene& scene);

/// The weights, one for each reading.
[[nodiscard]] std::vector<double> reading_weights(const CheckedSensor& sensor);

}  // namespace tactile_net::lab
