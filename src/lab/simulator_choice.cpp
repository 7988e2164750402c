#include "tactile_net/lab/simulator_choice.hpp"

#include <stdexcept>

#include "lab/library_simulator.hpp"

namespace tactile_net::lab {

std::unique_ptr<Simulator> make_simulator(const SimulatorChoice& choice) {
  if (!(choice.time_limit > 0.0) || choice.time_limit > 86'400.0)
    throw std::invalid_argument("the simulator's time limit must be > 0 and at most 86400 s");
  const std::chrono::milliseconds time_limit(static_cast<long>(1e3 * choice.time_limit) + 1);
  if (choice.kind == "library") {
    if (choice.ngspice.program != NgspiceOptions{}.program)
      throw std::invalid_argument("the simulator library starts no program, and one is named, '" +
                                  choice.ngspice.program +
                                  "': choose the simulator process, or name none");
    if (auto simulator = make_library_simulator(time_limit)) return simulator;
    throw std::invalid_argument(
        "this tactile-net was built without ngspice's library: choose the simulator process, or "
        "install libngspice0-dev, then configure and build again");
  }
  if (choice.kind != "process")
    throw std::invalid_argument("'" + choice.kind +
                                "' is not a simulator: choose process or library");
  NgspiceOptions options = choice.ngspice;
  options.time_limit = time_limit;
  return std::make_unique<Ngspice>(options);
}

}  // namespace tactile_net::lab
