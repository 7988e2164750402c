/// @file
/// How ngspice, which relaxes the circuits, is run.
#pragma once

#include <memory>

#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net::lab {

struct SimulatorChoice {
  NgspiceOptions ngspice{};
  double time_limit = 300.0;  ///< [s], of one run; > 0 and at most a day
};

/// @throw std::invalid_argument  the time limit is out of range
[[nodiscard]] std::unique_ptr<Simulator> make_simulator(const SimulatorChoice& choice = {});

}  // namespace tactile_net::lab
