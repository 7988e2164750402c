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

/// Which pins of a package take what; 0: it has none.
struct AmplifierPins {
  int in_plus = 0, in_minus = 0, out_plus = 0, out_minus = 0;
  int supply_plus = 0, supply_minus = 0;
  int common_mode = 0;  ///< takes the outputs' mean voltage
  int power_down = 0;   ///< works while it is high

  /// The usual ones of an SO-8.
  [[nodiscard]] static constexpr AmplifierPins single() noexcept {
    return {.in_plus = 3, .in_minus = 2, .out_plus = 6, .supply_plus = 7, .supply_minus = 4};
  }
  [[nodiscard]] static constexpr AmplifierPins fully_differential() noexcept {
    return {.in_plus = 8,
            .in_minus = 1,
            .out_plus = 4,
            .out_minus = 5,
            .supply_plus = 3,
            .supply_minus = 6,
            .common_mode = 2,
            .power_down = 7};
  }
};

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
  /// What it stands for; a pin is no part that is bought.
  enum class Kind { resistor, amplifier, capacitor, pin };
  Kind kind = Kind::resistor;
  std::string library{};   ///< KiCad's name of it
  std::size_t number = 0;  ///< from 1, of its kind
  /// The deck's name of it; of a pin that of its source or node; of a capacitor C and the name of
  /// the amplifier that it stands beside, or of the supply.
  std::string element{};
  std::string value{};  ///< "4.99k" and "499R", in ohms; what an amplifier is; what a pin is for
  std::string tolerance{};  ///< "0.1 %"; empty: none is said
  double watt = 0.0;        ///< of a resistor, as the circuit's sources drive it
  double rated_watt = 0.0;  ///< what a resistor of its size carries
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;  ///< of its courtyard, around the middle
  double height = 0.0;
  std::vector<BoardPad> pads{};

  /// The designator: R1, U1, C1, J1.
  [[nodiscard]] std::string reference() const;
  [[nodiscard]] bool overloaded() const noexcept { return watt > rated_watt; }
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
/// usual pins of one op-amp, or of a fully differential amplifier (1 -IN, 2 VOCM, 3 V+, 4 +OUT,
/// 5 -OUT, 6 V-, 7 power-down, 8 +IN): VOCM is at ground, and power-down, active low, at V+. Beside
/// the deck's parts each amplifier has a capacitor of 100 nF from VCC and one from VEE to ground,
/// and each supply one of 10 uF. The board is not routed.
///
/// Designators are numbered in the order of the circuit's resistors, of its amplifiers, and of the
/// pins. Courtyards do not overlap, and leave room for the designator above each.
///
/// @throw std::invalid_argument  the circuit has other parts, or sub-circuits; two nodes have one
///                               name, or one has the supply's
/// @throw std::domain_error      it has no unique operating point, so that powers are not known
[[nodiscard]] Board board_of(const SolderedCircuit& soldered);

/// The project of board.kicad_pcb, board.kicad_pro: tracks of 0.15 mm, clearances of 0.127 mm and
/// vias of 0.45 mm on 0.2 mm, which most makers of boards of four layers do without a surcharge.
void write_kicad_project(std::ostream& out);

/// As KiCad 6 writes it. Equal boards, equal bytes.
void write_kicad_board(std::ostream& out, const Board& board);

}  // namespace tactile_net
