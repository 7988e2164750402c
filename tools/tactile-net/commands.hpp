/// @file
/// The sub-commands of tactile-net: each file adds one to the parser.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net::tool {

void add_run(CLI::App& app);
void add_gen(CLI::App& app);
void add_relax(CLI::App& app);
void add_simulate(CLI::App& app);
void add_solve(CLI::App& app);
void add_identify(CLI::App& app);
void add_certify(CLI::App& app);
void add_plan(CLI::App& app);
void add_grasp(CLI::App& app);
void add_tradeoff(CLI::App& app);

/// "100us", "1 ms", "2e-5" [s]. @throw CLI::ValidationError  it is no time > 0
[[nodiscard]] double deadline_of(const std::string& text);

/// Which simulator, and for how long.
struct SimulatorChoice {
  std::string kind = "process";  ///< or "library"
  NgspiceOptions ngspice{};
  double time_limit = 300.0;  ///< [s], of one run
};

/// Adds --simulator, --ngspice and --time-limit.
void add_simulator_options(CLI::App& command, SimulatorChoice& choice);

/// @throw CLI::ValidationError  there is no such simulator, or it is not in this build; a program
/// is
///                              named for the library; the time limit is not > 0 or longer than a
///                              day
[[nodiscard]] std::unique_ptr<Simulator> make_simulator(const SimulatorChoice& choice);

/// ngspice's library, or nothing where this build has none (`no_library_simulator.cpp`).
[[nodiscard]] std::unique_ptr<Simulator> make_library_simulator(
    std::chrono::milliseconds time_limit);

/// What the command line says of the circuit, over the scene.
struct NetworkChoice {
  std::string realization{};
  std::optional<double> bandwidth{};  ///< of the op-amps [Hz]; absent: the scene's
};

/// Adds --realization and --bandwidth.
void add_network_options(CLI::App& command, NetworkChoice& choice);

/// @throw CLI::ValidationError  no realisation has that name, or the bandwidth is not > 0
void apply(const NetworkChoice& choice, Scene& scene);

}  // namespace tactile_net::tool
