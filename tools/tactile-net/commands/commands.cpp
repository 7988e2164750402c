#include "commands/commands.hpp"

#include <cmath>

namespace tactile_net::tool {

double deadline_of(const std::string& text) {
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  while (end < text.size() && text[end] == ' ') ++end;
  const std::string unit = text.substr(end);
  const double scale = unit == "ns"                   ? 1e-9
                       : unit == "us" || unit == "µs" ? 1e-6
                       : unit == "ms"                 ? 1e-3
                       : unit.empty() || unit == "s"  ? 1.0
                                                      : 0.0;
  if (end == 0 || scale == 0.0 || !(value > 0.0) || !std::isfinite(value))
    throw CLI::ValidationError("--deadline",
                               "'" + text + "' is no time > 0: write it as 100us, 1ms or 2e-5");
  return value * scale;
}

void add_simulator_options(CLI::App& command, lab::SimulatorChoice& choice) {
  command
      .add_option("--simulator", choice.kind,
                  "How to run ngspice: process starts the program for each circuit; library loads "
                  "ngspice once, in a process of its own, which is faster for small circuits")
      ->capture_default_str();
  command
      .add_option("--ngspice", choice.ngspice.program,
                  "The simulator's program, for --simulator process")
      ->capture_default_str();
  command.add_option("--time-limit", choice.time_limit, "Longest run of the simulator [s]")
      ->capture_default_str();
}

void add_network_options(CLI::App& command, NetworkChoice& choice) {
  command.add_option("--realization", choice.realization,
                     "Build the circuit as ideal, nic, rail, crossbar, least_squares, lc or ndr "
                     "(default: the scene's)");
  command.add_option("--bandwidth", choice.bandwidth,
                     "Gain-bandwidth product of the op-amps [Hz]; asks for the settling time too");
}

void apply(const NetworkChoice& choice, Scene& scene) {
  if (!choice.realization.empty()) {
    const auto realization = realization_named(choice.realization);
    if (!realization) {
      std::string names;
      for (const Realization one : realizations)
        names += (names.empty() ? "" : ", ") + std::string(name(one));
      throw CLI::ValidationError("--realization",
                                 "'" + choice.realization + "' is none of " + names);
    }
    scene.network.realization = *realization;
  }
  if (!choice.bandwidth) return;
  if (!(*choice.bandwidth >= 1e-3 && *choice.bandwidth <= 1e15))
    throw CLI::ValidationError("--bandwidth", "must be from 1e-3 to 1e15 Hz");
  const Realization realization = scene.network.realization;
  if (!has_amplifiers(realization))
    std::cerr << "note: " << name(realization) << " has no op-amps: --bandwidth changes nothing\n";
  lab::give_bandwidth(scene, *choice.bandwidth);
}

}  // namespace tactile_net::tool
