// Stands in for library_simulator.cpp where libngspice was not found.
#include "commands.hpp"

namespace tactile_net::tool {

std::unique_ptr<Simulator> make_library_simulator(std::chrono::milliseconds) { return nullptr; }

}  // namespace tactile_net::tool
