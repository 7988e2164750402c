/// @file
/// The command `tradeoff`: what accuracy costs in time.
#pragma once

#include <optional>
#include <string>

#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/simulator_choice.hpp"

namespace tactile_net::tool {

struct TradeoffOptions {
  std::string scene{};
  ResultOptions results{};
  std::optional<std::string> deadline{};
  std::optional<double> accuracy{};
  bool digital = false;
  bool resume = false;
  lab::SimulatorChoice simulator{.time_limit = 60.0};
};

/// @throw CheckFailed  stopped before the end, or no method meets the demand
void run(const TradeoffOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
