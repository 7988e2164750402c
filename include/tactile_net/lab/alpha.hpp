/// @file
/// What weighs the functional of one frame: given, or chosen by the scene's rules.
#pragma once

#include <optional>
#include <string_view>

#include "tactile_net/inverse/alpha.hpp"

namespace tactile_net::lab {

struct ChosenAlpha {
  double value = 0.0;                         ///< [unit of (W K)^2], > 0; 0: there is none
  std::optional<AlphaRule> rule{};            ///< that chose it; absent: the scene gives it
  AlphaVerdict verdict = AlphaVerdict::ok;    ///< of that rule; ok where it is given
  std::optional<double> tangential_weight{};  ///< estimated beside it; absent: the scene gives it

  [[nodiscard]] bool known() const noexcept { return value > 0.0; }
};

/// "given", or the rule's name.
[[nodiscard]] std::string_view source(const ChosenAlpha& alpha) noexcept;

}  // namespace tactile_net::lab
