// Stands in for library_simulator.cpp where libngspice was not found.
#include "lab/library_simulator.hpp"

namespace tactile_net::lab {

std::unique_ptr<Simulator> make_library_simulator(std::chrono::milliseconds) { return nullptr; }

}  // namespace tactile_net::lab
