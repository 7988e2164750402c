/// @file
/// The command `run`: simulate, reconstruct, compare with the truth.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "commands/network_options.hpp"
#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/simulator_choice.hpp"

namespace tactile_net::tool {

struct RunOptions {
  std::string scene{};
  ResultOptions results{};
  std::optional<std::size_t> frame{};
  bool compare_rules = false;
  bool explain = false;
  NetworkOptions network{};
  lab::SimulatorChoice simulator{};
};

/// @throw CheckFailed  not every method has an answer that holds
void run(const RunOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
