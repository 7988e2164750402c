/// @file
/// The sub-commands of tactile-net: each file adds one to the parser.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/scene/scene.hpp"

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

/// Adds --simulator, --ngspice and --time-limit.
void add_simulator_options(CLI::App& command, lab::SimulatorChoice& choice);

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
