/// @file
/// The command `grasp`: what a hand's fingertip forces mean.
#pragma once

#include <string>

#include "commands/results.hpp"
#include "streams.hpp"

namespace tactile_net::tool {

struct GraspOptions {
  std::string hand{};
  bool allow_outside = false;  ///< files elsewhere than beside the hand's and below
  ResultOptions results{};
  std::string columns{};
};

/// @throw CheckFailed  the grasp fails
void run(const GraspOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
