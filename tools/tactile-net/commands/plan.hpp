/// @file
/// The command `plan`: the file that a controller loads.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "streams.hpp"
#include "tactile_net/control/planner.hpp"

namespace tactile_net::tool {

struct PlanOptions {
  std::string scene{};
  std::string output{};
  std::string readings{};
  std::optional<Structure> structure{};
  std::optional<Precision> precision{};
  std::string json{};
  std::string columns{};
  std::optional<std::string> deadline{};
  double accuracy = PlannerOptions{}.accuracy;
  std::optional<double> friction{};
  std::optional<double> friction_limit{};
  bool nonnegative = false;
  std::optional<std::size_t> steps{};
  double share = 0.5;
  bool no_diagnostics = false;
  bool allow_fft = false;
};

/// @throw CheckFailed  a frame takes longer than the deadline
void run(const PlanOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
