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
  std::string folder{};
  bool force = false;
  std::string json{};
  std::optional<std::size_t> jobs{};
  std::string shard = "1/1";
  bool allow_outside = false;
  std::optional<std::size_t> slurm{};
  std::string time = "1:00:00";
  lab::SimulatorChoice simulator{};
};

struct MergeOptions {
  std::vector<std::string> folders{};
  std::string folder{};  ///< of the results; empty: the first of `folders`
  bool force = false;
  std::string json{};
};

/// @throw CheckFailed  stopped before the end, or no point has an answer
void run(const SweepOptions& options, const Streams& streams);

/// @throw std::runtime_error  points are missing
/// @throw CheckFailed         no point has an answer
void run(const MergeOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
