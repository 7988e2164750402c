/// @file
/// Where a package's pins are soldered.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/network/board.hpp"

namespace tactile_net {

/// A footprint as KiCad's library has it; sizes in millimetres.
struct PackageLands {
  std::string library{};
  double width = 0.0, height = 0.0;  ///< of its courtyard
  std::vector<BoardPad> pads{};      ///< in the order of their numbers, without nets
};

/// @throw std::invalid_argument  there is no footprint of that package
[[nodiscard]] PackageLands lands_of(const AmplifierPackage& package);

}  // namespace tactile_net
