/// @file
/// The command `report`: many recordings of one sensor, a row each, the most suspicious first.
#pragma once

#include <string>
#include <vector>

#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/missing.hpp"

namespace tactile_net::tool {

struct ReportOptions {
  std::vector<std::string> recordings{};  ///< files, and folders that hold some
  std::string scene{};
  ResultOptions results{};
  std::string csv{};
  std::string columns{};
  lab::Missing missing = lab::Missing::fail;
  bool recursive = false;  ///< folders inside of folders are searched too
  bool no_pages = false;   ///< recordings have no pages of their own
};

/// @throw CheckFailed  a recording could not be read or solved: its row says why, and all others
///                     are solved
void run(const ReportOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
