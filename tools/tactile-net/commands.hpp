/// @file
/// The sub-commands of tactile-net: each file adds one to the parser.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

#include "tactile_net/network/realization.hpp"
#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net::tool {

void add_run(CLI::App& app);
void add_gen(CLI::App& app);
void add_relax(CLI::App& app);
void add_solve(CLI::App& app);
void add_identify(CLI::App& app);

/// Adds --ngspice and --time-limit [s].
void add_ngspice_options(CLI::App& command, NgspiceOptions& options, double& time_limit);

/// @throw CLI::ValidationError  not > 0 or longer than a day
[[nodiscard]] std::chrono::milliseconds checked_time_limit(double seconds);

/// @throw CLI::ValidationError  no realisation of this version has that name
[[nodiscard]] Realization parse_realization(const std::string& name);

}  // namespace tactile_net::tool
