/// @file
/// A soldered circuit as a board: footprints where the array has them, and the net of every pad.
///
///     const Board board = board_of(soldered);      // part_values.hpp
///     write_kicad_board(std::cout, board);         // a .kicad_pcb of KiCad 6 and later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/network/part_values.hpp"

namespace tactile_net {

/// Places and sizes are in millimetres, y down.
struct BoardPad {
  std::string name{};
  double x = 0.0;  ///< from the footprint's middle
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  std::size_t net = 0;  ///< index into `Board::nets`; 0: none
  bool drilled = false;
};

struct Footprint {
  std::string library{};    ///< KiCad's name of it
  std::string reference{};  ///< as in the deck
  std::string value{};
  std::string tolerance{};  ///< "0.1 %"; empty: none is said
  double x = 0.0;
  double y = 0.0;
  std::vector<BoardPad> pads{};
};

struct Board {
  std::vector<std::string> nets{};  ///< nets[0] is "", no net; the others once each
  std::vector<Footprint> footprints{};
  double width = 0.0;
  double height = 0.0;
};

/// Resistors stand in the rows and columns of their entries, the stabiliser's below them,
/// amplifiers below those; each current source is a pin that takes a reading, each output a pin,
/// and the supply has three. Nets are the deck's nodes, ground is GND, and op-amps are fed by VCC
/// and VEE. Parts of the coarsest class are 0402, better ones 0603; amplifiers are SO-8 with the
/// usual pins of one op-amp, or of one with two outputs (1 -IN, 2 VOCM, 3 V+, 4 +OUT, 5 -OUT, 6 V-,
/// 8 +IN). Nothing is routed, and nothing stands on it that is not in the deck: capacitors of the
/// supply are not.
///
/// @throw std::invalid_argument  the circuit has other parts, or sub-circuits
[[nodiscard]] Board board_of(const SolderedCircuit& soldered);

/// As KiCad 6 writes it. Equal boards, equal bytes.
void write_kicad_board(std::ostream& out, const Board& board);

}  // namespace tactile_net
