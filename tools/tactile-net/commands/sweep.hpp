/// @file
/// The commands `sweep` and `merge`: a scene at many values, on one machine or on many.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "streams.hpp"
#include "tactile_net/lab/simulator_choice.hpp"

namespace tactile_net::tool {

struct SweepOptions {
  std::string study{};
  std::string file{};  ///< of rows
  std::string json{};
  std::optional<std::size_t> jobs{};
  std::string points{};  ///< empty: all
  bool allow_outside = false;
  lab::SimulatorChoice simulator{};
};

struct MergeOptions {
  std::vector<std::string> files{};
  std::string folder{};  ///< of the results; empty: none
  bool force = false;
  std::string json{};
};

/// @throw CheckFailed  stopped before the end, or no point has an answer
void run(const SweepOptions& options, const Streams& streams);

/// @throw std::runtime_error  points are missing
/// @throw CheckFailed         no point has an answer
void run(const MergeOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
