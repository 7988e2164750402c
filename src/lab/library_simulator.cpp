#include "lab/library_simulator.hpp"

#include "tactile_net/simulator/ngspice_library.hpp"

namespace tactile_net::lab {

std::unique_ptr<Simulator> make_library_simulator(std::chrono::milliseconds time_limit) {
  return std::make_unique<NgspiceLibrary>(NgspiceLibraryOptions{.time_limit = time_limit});
}

}  // namespace tactile_net::lab
