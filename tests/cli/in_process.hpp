/// @file
/// The command in this process.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/simulator/child_process.hpp"

namespace tactile_net::test {

/// What the command says on its streams, and its exit status.
///
/// @param somebody  sits at a terminal, and `input` is what they type
ProcessResult run_in_process(const std::vector<std::string>& arguments, const std::string& input,
                             bool somebody = false);

}  // namespace tactile_net::test
