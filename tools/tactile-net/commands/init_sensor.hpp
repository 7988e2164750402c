/// @file
/// The command `init` for a sensor that is known by name, without a recording.
#pragma once

#include "commands/init.hpp"

namespace tactile_net::tool {

/// Writes the scene, and the file of the taxels beside it where they are on no lattice.
///
/// @throw WrongUsage  the sensor, or its model, is not known; its places are not; it has no elastic
///                    model; something is not given, and nobody is there
void init_sensor(const InitOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
