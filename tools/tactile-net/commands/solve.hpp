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
  std::string columns{};
  std::string missing = "fail";
};

/// @throw InputError  a frame is bad; the answers of those before it are in NAME.partial, which the
///                    error's text names
void run(const SolveOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
