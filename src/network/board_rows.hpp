/// @file
/// A board's parts in rows, and the tracks that join them.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/network/board.hpp"

namespace tactile_net {

/// Which footprints of a board go where: indices into `Board::footprints`.
struct BoardFootprints {
  /// Resistors that stand in one place: one, or both of a pair, the first from its first node.
  std::vector<std::vector<std::size_t>> resistors{};
  std::vector<std::vector<std::size_t>> amplifiers{};  ///< each with its capacitors
  std::vector<std::size_t> test_points{};
  std::vector<std::size_t> inputs{};                   ///< along the upper edge
  std::vector<std::size_t> outputs{};                  ///< along the lower edge, with the supply
  std::size_t ground = 0, positive = 0, negative = 0;  ///< nets
};

/// Parts that stand side by side, in their order from the left.
struct BoardRow {
  std::vector<std::size_t> parts{};  ///< whose x and angle are set
  bool begins_section = false;       ///< tracks along y may leave for another place above it
  bool down = false;                 ///< pads in the middle of their part are reached from below
  double room_above = 0.0;           ///< for labels [mm]
  double room_below = 0.0;
  std::string name{};  ///< of the net above them, where it is one
  std::vector<std::pair<double, std::string>> columns{};  ///< at x, names above them
  double top = 0.0, bottom = 0.0;  ///< what it takes of the board, once tracks are laid
};

/// Sets the parts' x and angle and the board's width, and labels. A row of resistors is of one net
/// that many of them have, above them; those of one net below them stand in one column, as far as
/// there is room.
[[nodiscard]] std::vector<BoardRow> place_in_rows(Board& board, const BoardFootprints& parts);

/// Sets the parts' y and the board's height, and lays every track. Above and below each row is a
/// channel of tracks along x on the top layer, of as many as it takes; nets of several channels
/// have a track along y on the bottom layer, which keeps clear of every pad's x. A pad is joined to
/// its channel by a track straight up or down, or by one on the bottom layer where others are in
/// its way. So every net is joined, whatever the parts: the board only grows. A pad of a plane's
/// net, ground or the positive supply, has a via; the negative supply is laid wide.
void lay_tracks(Board& board, std::vector<BoardRow>& rows, const BoardFootprints& parts);

/// The title, and the nets that rows and columns are of.
void add_labels(Board& board, const std::vector<BoardRow>& rows, const std::string& title);

/// A pad as it lies on the board, from the part's middle.
[[nodiscard]] BoardPad turned(const BoardPad& pad, double angle) noexcept;

/// How far a part reaches from its middle along x and along y.
[[nodiscard]] std::pair<double, double> half_size(const Footprint& part) noexcept;

}  // namespace tactile_net
