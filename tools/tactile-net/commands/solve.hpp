/// @file
/// The command `solve`: recorded readings to tractions, frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/missing.hpp"

namespace tactile_net::tool {

struct SolveOptions {
  std::string scene{};
  std::string readings{};
  Method method = Method::tikhonov;
  std::string output{};
  std::string uncertainty{};
  ResultOptions results{};
  std::string columns{};
  lab::Missing missing = lab::Missing::fail;
  std::optional<std::size_t> share_alpha{};
  std::string plan{};
  std::string contacts{};  ///< of the plan
};

/// @throw InputError  a frame is bad; the answers of those before it are in NAME.partial, which the
///                    error's text names
void run(const SolveOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
