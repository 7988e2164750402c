/// @file
/// The command `calibrate`: what a log of presses says of a pad and its sensor.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "commands/results.hpp"
#include "streams.hpp"

namespace tactile_net::tool {

struct CalibrateOptions {
  std::string log{};
  std::string scene{};
  std::string output{};  ///< the scene's file again, with what was found; empty: none
  ResultOptions results{};
  bool robust = false;
  std::optional<std::size_t> next{};  ///< presses to plan
  std::string target{};               ///< what they are to tell; empty: readings
  std::vector<std::string> fixed{};   ///< names of parameters
};

void run(const CalibrateOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
