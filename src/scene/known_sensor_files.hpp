/// @file
/// The files of sensors/, compiled in. Private.
#pragma once

#include <span>
#include <string_view>

namespace tactile_net {

/// sensors.toml.
[[nodiscard]] std::string_view known_sensors_toml() noexcept;

struct KnownSensorModel {
  std::string_view sensor;  ///< "paxini"
  std::string_view model;   ///< "PXSR-STDDP03A"
  std::string_view taxels;  ///< CSV
};

[[nodiscard]] std::span<const KnownSensorModel> known_sensor_models() noexcept;

}  // namespace tactile_net
