/// @file
/// How far the voltage of a supply falls on its way over a board's tracks.
///
///     const auto drop = supply_drop(board, "VEE");  // laid_board.hpp
///     drop->ohm * ampere;                           // each op-amp takes that much
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tactile_net/network/laid_board.hpp"

namespace tactile_net {

struct SupplyDrop {
  double ohm = 0.0;  ///< the farthest op-amp's fall of voltage, over what each op-amp takes [ohm]
  std::string amplifier{};     ///< which that is, by its name in the deck
  std::size_t amplifiers = 0;  ///< that take it, all alike
};

/// From the pins of the part "supply" to those of the op-amps, parts X...: tracks and the barrels
/// of vias, of copper of 1.72e-8 ohm m, inner layers as thick as outer ones. Along a track's
/// middle, so that a bus is as if its current were spread over its width at once.
///
/// @param net  its name
/// @return     nothing if the net has no such part, no op-amp, a plane or other filled zone, or
/// does
///             not reach all of them by tracks
[[nodiscard]] std::optional<SupplyDrop> supply_drop(const LaidBoard& board, const std::string& net);

}  // namespace tactile_net
