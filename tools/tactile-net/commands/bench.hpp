/// @file
/// The command `bench`: a built board from its measured responses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "commands/network_options.hpp"
#include "commands/results.hpp"
#include "streams.hpp"

namespace tactile_net::tool {

struct BenchOptions {
  std::string scene{};
  std::string measured{};
  std::optional<double> noise{};      ///< of a voltage [V]; absent: of 12 bits
  std::string simulate{};             ///< a file that is written instead of reading one
  std::vector<std::string> faults{};  ///< planted, where it is simulated
  std::optional<std::size_t> bits{};  ///< absent: 12
  std::optional<std::size_t> seed{};  ///< absent: 1
  NetworkOptions network{};
  ResultOptions results{};
};

/// @throw CheckFailed  the board has a fault, or is not explained
void run(const BenchOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
