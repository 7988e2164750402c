/// @file
/// The commands about the command line itself: `help`, `completion`, and the release.
#pragma once

#include <string>

#include "command_line/completion.hpp"
#include "streams.hpp"

namespace tactile_net::tool {

struct HelpOptions {
  std::string command{};  ///< empty: of the program
  bool man = false;       ///< the manual page instead
};

struct CompletionOptions {
  Shell shell = Shell::bash;
};

struct ReleaseOptions {};

void run(const HelpOptions& options, const Streams& streams);
void run(const CompletionOptions& options, const Streams& streams);
void run(const ReleaseOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
