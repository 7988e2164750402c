/// @file
/// The table [calibration], of a line or of a skin. Private.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/sections.hpp"
#include "tactile_net/sensing/calibration.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net {

/// What a calibration is told of the sensor. Nothing in it: the sensor was not understood.
struct CalibratedReadings {
  std::vector<std::string_view> names{};       ///< of the quantities, as sensor.reads has them
  std::vector<std::string_view> quantities{};  ///< of each reading
  std::vector<Unit> units{};                   ///< of each reading
  std::vector<std::string> ids{};              ///< of each reading, as a recording's columns
};

/// @param sensor  a `SensorArray` or a `SkinArray` that was understood
[[nodiscard]] CalibratedReadings calibrated_readings(const auto& sensor, const Units& units) {
  CalibratedReadings result{.ids = reading_names(sensor)};
  for (const auto quantity : sensor.reads) result.names.push_back(name(quantity));
  for (const auto& site : sites(sensor)) {
    result.quantities.push_back(name(site.quantity));
    result.units.push_back(unit_of(units, traits(site.quantity).kind));
  }
  return result;
}

/// What the numbers of a recording mean, by the table and the units of readings.
///
/// @param given   absent: the units alone
/// @param folder  of the scene's file: of the file that the table names
/// @return nothing: the numbers are readings in SI, or the sensor was not understood
[[nodiscard]] std::optional<Calibration> read_calibration(const std::optional<Table>& given,
                                                          const std::filesystem::path& folder,
                                                          const CalibratedReadings& readings);

}  // namespace tactile_net
