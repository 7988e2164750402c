/// @file
/// Which simulator relaxes the circuits.
#pragma once

#include <memory>
#include <string>

#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net::lab {

struct SimulatorChoice {
  std::string kind = "process";  ///< the program, once per circuit; or "library", loaded once
  NgspiceOptions ngspice{};
  double time_limit = 300.0;  ///< [s], of one run; > 0 and at most a day
};

/// @throw std::invalid_argument  there is no such simulator, or it is not in this build; a program
///                               is named for the library; the time limit is out of range
[[nodiscard]] std::unique_ptr<Simulator> make_simulator(const SimulatorChoice& choice = {});

}  // namespace tactile_net::lab
