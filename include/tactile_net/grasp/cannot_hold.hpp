/// @file
/// Why no torques hold a load: for callers that go on with the answer.
#pragma once

#include <stdexcept>

namespace tactile_net {

/// Why no torques hold a load.
enum class NoHold {
  undetermined,           ///< part of the contact forces costs no torque, so that none is the least
  beyond_cones,           ///< no forces within the friction cones are in equilibrium with the load
  beyond_cones_squeezed,  ///< as beyond_cones, with the squeeze that was asked for
  no_forces,              ///< no forces of these contacts at all, of whatever sign, carry the load
  not_found,              ///< the search for the least torques within the cones did not end
};

/// What an error says: the condition that is violated.
[[nodiscard]] constexpr const char* rule(NoHold reason) noexcept {
  switch (reason) {
    case NoHold::undetermined:
      return "the torques do not determine the contact forces: some forces of the fingers against "
             "each other pass through their joints and cost none";
    case NoHold::beyond_cones:
      return "no forces within the friction cones carry the load";
    case NoHold::beyond_cones_squeezed:
      return "no forces within the friction cones carry the load with that squeeze";
    case NoHold::no_forces:
      return "no forces at these contacts carry the load, however hard they press";
    case NoHold::not_found:
      return "the least torques within the friction cones were not found";
  }
  return "";
}

/// No torques hold the load; `reason()` says why.
class CannotHold : public std::domain_error {
 public:
  explicit CannotHold(NoHold reason) : std::domain_error(rule(reason)), reason_(reason) {}
  [[nodiscard]] NoHold reason() const noexcept { return reason_; }

 private:
  NoHold reason_;
};

}  // namespace tactile_net
