/// @file
/// A board's circuit as a schematic of KiCad 6 and newer, a sheet a row.
///
///     for (const SchematicFile& file : kicad_schematic(board))
///       frames::write_file(file.name, file.text);   // "board.kicad_sch" first
#pragma once

#include <string>
#include <vector>

#include "tactile_net/network/board.hpp"

namespace tactile_net {

struct SchematicFile {
  std::string name{};
  std::string text{};
};

/// board.kicad_sch, which has headers, the supply and a sheet for each row of the arrays, and those
/// sheets, board-row0.kicad_sch and so on. In a row's sheet stand the resistors of its entries,
/// array by array, its amplifier with its capacitors and its test points. Every part of the board
/// stands on one of them once, with its designator, value, footprint, tolerance and name in the
/// deck; the net of each of its pins is a global label there, and a pin without a net is marked as
/// such. Symbols are in the files: no library is needed. KiCad's check of electrical rules has
/// nothing to find: pins have types, GND, VCC and VEE a PWR_FLAG, and every other net two pins or
/// more.
///
/// @param amplifier_part  what amplifiers are ordered by; empty: not known
/// @return                equal boards, equal bytes
/// @throw std::invalid_argument  pads of one name of a footprint are of different nets
[[nodiscard]] std::vector<SchematicFile> kicad_schematic(const Board& board,
                                                         const std::string& amplifier_part = {});

}  // namespace tactile_net
