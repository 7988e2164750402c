#include "commands.hpp"

namespace tactile_net::tool {

void add_ngspice_options(CLI::App& command, NgspiceOptions& options, double& time_limit) {
  command.add_option("--ngspice", options.program, "The simulator's program")
      ->capture_default_str();
  command.add_option("--time-limit", time_limit, "Longest run of ngspice [s]")
      ->capture_default_str();
}

std::chrono::milliseconds checked_time_limit(double seconds) {
  if (!(seconds > 0.0) || seconds > 86'400.0)
    throw CLI::ValidationError("--time-limit", "must be > 0 and at most 86400 s");
  return std::chrono::milliseconds(static_cast<long>(1e3 * seconds) + 1);
}

Realization parse_realization(const std::string& name) {
  if (const auto realization = realization_named(name)) return *realization;
  throw CLI::ValidationError("--realization",
                             "'" + name + "' is not built by this version: ideal or nic");
}

}  // namespace tactile_net::tool
