/// @file
/// A recording's solution as JSON.
#pragma once

#include <span>
#include <string>

#include "tactile_net/lab/missing.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/summary.hpp"

namespace tactile_net::report {

/// What `solve` says of itself.
struct SolveReport {
  std::string readings{};  ///< where they come from, as the user wrote it
  std::span<const std::string> columns_ignored{};
  lab::Missing missing = lab::Missing::fail;
  lab::Remarks remarks{};  ///< of the last frame; without one, of the method
  double seconds = 0.0;
};

/// With what is suspicious about the readings, each frame that the overview shows, without its
/// tractions, and of a skin what every frame amounts to.
[[nodiscard]] std::string solve_json(const lab::RecordingOverview& overview,
                                     const lab::SolvedFrames& solved, const SolveReport& report);

}  // namespace tactile_net::report
