/// @file
/// The command `solve`: recorded readings to tractions, frame by frame.
#pragma once

#include <string>

#include "streams.hpp"

namespace tactile_net::tool {

struct SolveOptions {
  std::string scene{};
  std::string readings{};
  std::string method = "tikhonov";
  std::string output{};
  std::string uncertainty{};
  std::string json{};
  std::string folder{};  ///< of report.html and what is beside it; empty: none
};

/// @throw InputError  a frame is bad; everything before it has been written
void run(const SolveOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
