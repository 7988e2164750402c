/// @file
/// ngspice's library, or nothing where this build has none (`no_library_simulator.cpp`).
#pragma once

#include <chrono>
#include <memory>

#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::lab {

[[nodiscard]] std::unique_ptr<Simulator> make_library_simulator(
    std::chrono::milliseconds time_limit);

}  // namespace tactile_net::lab
