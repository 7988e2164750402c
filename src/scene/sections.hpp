/// @file
/// The tables of a scene, one function each: from checked values to plain data.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/common_sections.hpp"
#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net {

/// Fills the scene from the whole file; what is wrong goes to the problems that `root` was made
/// with, and then the scene is not complete.
///
/// @param folder  of the scene's file: of the files that it names
void read_sections(Table& root, const std::filesystem::path& folder, Scene& scene);

/// The table [sensor].
///
/// @param folder  of the scene's file
[[nodiscard]] SensorArray read_sensor(Table table, const std::filesystem::path& folder, Read& read);

/// The unit of alpha and of the matrix P: that of weighted readings over tractions, squared.
[[nodiscard]] Unit alpha_unit(const Units& units, const Scene& scene) noexcept;

/// The contacts; the sensor has count 0 or pitch 0 where that was wrong, and is then not compared
/// with.
void read_contacts(std::vector<Table> tables, const Read& read, Scene& scene);

/// The table [calibrate]: how well what the scene states is known.
[[nodiscard]] CalibrationOptions read_calibrate(Table table, const Units& units, bool has_layer,
                                                bool is_skin);

}  // namespace tactile_net
