/// @file
/// A finger of a hand's file made ready: its contact read, or reconstructed from readings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/scene/hand.hpp"

namespace tactile_net::lab {

struct Fingertip {
  Finger finger{};                        ///< the pad's half width filled in
  std::optional<FingertipForce> force{};  ///< absent: the contact is only assumed
  ContactPlace place{};
  std::string source{};  ///< "resultant", "tractions", "readings", "simulated" or "assumed"
  std::string words{};   ///< where it comes from, for people
  std::vector<std::string> warnings{};
};

/// @param folder  what relative paths are below
/// @throw InputError         a scene or CSV file is bad, or has no such frame
/// @throw std::domain_error  nothing presses on the pad, or beside it: the text names the finger
[[nodiscard]] Fingertip make_fingertip(const HandFinger& finger,
                                       const std::filesystem::path& folder);

}  // namespace tactile_net::lab
