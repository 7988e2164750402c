#include "tactile_net/lab/simulator_choice.hpp"

#include <stdexcept>

namespace tactile_net::lab {

std::unique_ptr<Simulator> make_simulator(const SimulatorChoice& choice) {
  if (!(choice.time_limit > 0.0) || choice.time_limit > 86'400.0)
    throw std::invalid_argument("the simulator's time limit must be > 0 and at most 86400 s");
  NgspiceOptions options = choice.ngspice;
  options.time_limit = std::chrono::milliseconds(static_cast<long>(1e3 * choice.time_limit) + 1);
  return std::make_unique<Ngspice>(options);
}

}  // namespace tactile_net::lab
