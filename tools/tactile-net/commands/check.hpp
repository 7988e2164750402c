/// @file
/// The command `check`: whether a recording fits its scene, and what looks wrong.
#pragma once

#include <string>

#include "streams.hpp"

namespace tactile_net::tool {

struct CheckOptions {
  std::string scene{};
  std::string readings{};
  std::string columns{};
  std::string json{};
  bool strict = false;  ///< suspicions are a failure
};

/// @throw CheckFailed  there are suspicions, and `strict` is asked for
void run(const CheckOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
