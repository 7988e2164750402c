/// @file
/// The command `identify`: what a scene's sensors can tell apart.
#pragma once

#include <string>

#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/identify.hpp"

namespace tactile_net::tool {

struct IdentifyOptions {
  std::string scene{};
  std::string readings{};  ///< recorded ones, as strong as what is to be told; empty: none
  std::string columns{};
  ResultOptions results{};
  lab::SurveyOptions survey{};
};

void run(const IdentifyOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
