/// @file
/// The command line, parsed.
#pragma once

#include <span>
#include <string>
#include <variant>

#include "command_line/table.hpp"
#include "commands/bench.hpp"
#include "commands/calibrate.hpp"
#include "commands/certify.hpp"
#include "commands/check.hpp"
#include "commands/gen.hpp"
#include "commands/grasp.hpp"
#include "commands/help.hpp"
#include "commands/identify.hpp"
#include "commands/init.hpp"
#include "commands/plan.hpp"
#include "commands/relax.hpp"
#include "commands/report.hpp"
#include "commands/run.hpp"
#include "commands/schema.hpp"
#include "commands/simulate.hpp"
#include "commands/solve.hpp"
#include "commands/sweep.hpp"
#include "commands/tradeoff.hpp"

namespace tactile_net::tool {

/// What one command was asked for: `run` takes it.
using Command = std::variant<RunOptions, GenOptions, RelaxOptions, CertifyOptions, SimulateOptions,
                             SolveOptions, ReportOptions, IdentifyOptions, PlanOptions,
                             TradeoffOptions, GraspOptions, SweepOptions, MergeOptions, InitOptions,
                             CheckOptions, CalibrateOptions, BenchOptions, SchemaOptions,
                             HelpOptions, CompletionOptions, ReleaseOptions>;

struct Invocation {
  Command command{};
  bool quiet = false;  ///< errors are told, and nothing else
};

/// Checks presence and type of what was given; ranges are the business of whoever uses it.
///
/// @param arguments  without the program's name
/// @throw WrongUsage
[[nodiscard]] Invocation parse(std::span<const std::string> arguments);

/// What `parse` takes, for help.
[[nodiscard]] const CommandLine& command_line();

}  // namespace tactile_net::tool
