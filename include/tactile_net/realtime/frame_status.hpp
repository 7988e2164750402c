/// @file
/// Outcome of one frame in a control loop. Part of tactile_net::rt, which depends on nothing.
#pragma once

#include <string_view>

namespace tactile_net {

/// The output holds a result only for `ok`; on anything else it is untouched. As an int: 0 is ok,
/// errors are negative.
// clang-format off
enum class [[nodiscard]] FrameStatus : int {
  ok = 0,
  wrong_size = -1,  ///< the readings or the room for the tractions are not of the plan's size
  not_finite = -2,  ///< a reading that counts is NaN or infinite
  too_large = -3,   ///< finite, but its tractions might overflow a double: scale the readings
};
// clang-format on

[[nodiscard]] constexpr std::string_view name(FrameStatus status) noexcept {
  switch (status) {
    case FrameStatus::ok:
      return "ok";
    case FrameStatus::wrong_size:
      return "wrong_size";
    case FrameStatus::not_finite:
      return "not_finite";
    case FrameStatus::too_large:
      return "too_large";
  }
  return "unknown";
}

}  // namespace tactile_net
