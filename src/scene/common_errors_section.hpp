/// @file
/// What all resistors of a circuit have in common, in network.tolerance. Private.
#pragma once

#include <filesystem>

#include "scene/table.hpp"
#include "tactile_net/network/resistor_errors.hpp"

namespace tactile_net {

/// The keys reel, measured and temperature.
///
/// @param folder  of the scene's file
[[nodiscard]] CommonErrors read_common_errors(Table& tolerance,
                                              const std::filesystem::path& folder);

}  // namespace tactile_net
