/// @file
/// One frame of a file, by its number.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "tactile_net/frames/open.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::frames {

/// @param file    readings of the scene's sensor, CSV or .npy
/// @param number  of the frame, from 0
/// @return        channels x count
/// @throw InputError  as `ReadingsFile`; there are not that many frames
[[nodiscard]] std::vector<double> readings_of_frame(const std::filesystem::path& file,
                                                    const Scene& scene, std::size_t number,
                                                    const ReadingsOptions& options = {});

/// The same of a skin. @return  in the order of the skin's readings
[[nodiscard]] std::vector<double> readings_of_frame(const std::filesystem::path& file,
                                                    const SkinScene& scene, std::size_t number,
                                                    const ReadingsOptions& options = {});

/// @param file    tractions as `solve` writes them, CSV
/// @param number  of the frame, from 0
/// @throw InputError  as `CsvFrames`; there are not that many frames
[[nodiscard]] TractionField tractions_of_frame(const std::filesystem::path& file,
                                               std::size_t number);

}  // namespace tactile_net::frames
