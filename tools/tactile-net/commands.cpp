#include "commands.hpp"

namespace tactile_net::tool {

void add_simulator_options(CLI::App& command, SimulatorChoice& choice) {
  command.add_option("--ngspice", choice.ngspice.program, "The simulator's program")
      ->capture_default_str();
  command.add_option("--time-limit", choice.time_limit, "Longest run of the simulator [s]")
      ->capture_default_str();
}

std::unique_ptr<Simulator> make_simulator(const SimulatorChoice& choice) {
  if (!(choice.time_limit > 0.0) || choice.time_limit > 86'400.0)
    throw CLI::ValidationError("--time-limit", "must be > 0 and at most 86400 s");
  NgspiceOptions options = choice.ngspice;
  options.time_limit = std::chrono::milliseconds(static_cast<long>(1e3 * choice.time_limit) + 1);
  return std::make_unique<Ngspice>(options);
}

Realization parse_realization(const std::string& name) {
  if (const auto realization = realization_named(name)) return *realization;
  std::string names;
  for (const Realization one : realizations)
    names += (names.empty() ? "" : ", ") + std::string(tactile_net::name(one));
  throw CLI::ValidationError("--realization", "'" + name + "' is none of " + names);
}

}  // namespace tactile_net::tool
