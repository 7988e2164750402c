/// @file
/// The command line, parsed.
#pragma once

#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "commands/certify.hpp"
#include "commands/check.hpp"
#include "commands/gen.hpp"
#include "commands/grasp.hpp"
#include "commands/identify.hpp"
#include "commands/init.hpp"
#include "commands/plan.hpp"
#include "commands/relax.hpp"
#include "commands/run.hpp"
#include "commands/simulate.hpp"
#include "commands/solve.hpp"
#include "commands/tradeoff.hpp"

namespace tactile_net::tool {

/// What one command was asked for: `run` takes it.
using Command = std::variant<RunOptions, GenOptions, RelaxOptions, CertifyOptions, SimulateOptions,
                             SolveOptions, IdentifyOptions, PlanOptions, TradeoffOptions,
                             GraspOptions, InitOptions, CheckOptions>;

/// Checks presence and type of what was given; ranges are the business of whoever uses it.
///
/// @param arguments  without the program's name
/// @param out        gets the text of --help and --version, which are no command
/// @throw WrongUsage
[[nodiscard]] std::optional<Command> parse(std::span<const std::string> arguments,
                                           std::ostream& out);

}  // namespace tactile_net::tool
