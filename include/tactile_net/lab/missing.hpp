/// @file
/// Frames in which readings are missing, and what a `RecordingSolver` makes of them.
#pragma once

#include <optional>
#include <string_view>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::lab {

/// What becomes of a frame in which a reading is missing.
enum class Missing {
  fail,  ///< the recording is refused
  skip,  ///< it gets no answer
  /// It is solved from the taxels whose readings are all there: one that misses a reading is dead
  /// in that frame, with all its channels.
  estimate,
};

[[nodiscard]] std::string_view name(Missing missing) noexcept;
[[nodiscard]] std::optional<Missing> missing_named(std::string_view name) noexcept;

/// Whether frames can be solved without some taxels: by a method that knows dead ones, of a skin or
/// of an array that has a matrix.
[[nodiscard]] bool can_leave_out(const AnyProblem& problem, Method method);

}  // namespace tactile_net::lab
