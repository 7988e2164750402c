/// @file
/// The sub-commands of tactile-net: each file adds one to the parser.
#pragma once

#include <CLI/CLI.hpp>

namespace tactile_net::tool {

void add_run(CLI::App& app);
void add_gen(CLI::App& app);
void add_relax(CLI::App& app);
void add_solve(CLI::App& app);

}  // namespace tactile_net::tool
