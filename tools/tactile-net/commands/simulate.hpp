/// @file
/// The command `simulate`: what a scene's sensor reads, recorded.
#pragma once

#include <string>

#include "streams.hpp"

namespace tactile_net::tool {

struct SimulateOptions {
  std::string scene{};
  std::string output{};
  std::string truth{};
  std::string json{};
};

void run(const SimulateOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
