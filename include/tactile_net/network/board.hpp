/// @file
/// A soldered circuit as a board: footprints where the array has them, and the net of every pad.
///
///     const Board board = board_of(soldered);      // part_values.hpp
///     write_kicad_board(std::cout, board);         // a .kicad_pcb of KiCad 6 and later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
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
  /// What an amplifier's pin is for: "IN+", "OUT", "V-", "VOCM", "PD", "EP"; of the second in a
  /// package "IN2+"; empty: open, or no amplifier's.
  std::string purpose{};
};

struct Footprint {
  /// What it stands for; from test_point on it is no part that is bought.
  enum class Kind { resistor, amplifier, capacitor, header, test_point, screw };
  Kind kind = Kind::resistor;
  std::string library{};   ///< KiCad's name of it
  std::size_t number = 0;  ///< from 1, of its kind
  /// The deck's name of it; of a header what it carries: "inputs1", "outputs1", "supply"; of a
  /// capacitor C and the name of the amplifier that it stands beside, or of the supply.
  std::string element{};
  std::string value{};      ///< "4.99k" and "499R", in ohms; what an amplifier or a header is
  std::string tolerance{};  ///< "0.1 %"; empty: none is said
  double watt = 0.0;        ///< of a resistor, as the circuit's sources drive it
  double rated_watt = 0.0;  ///< what a resistor of its size carries
  double x = 0.0;
  double y = 0.0;
  double angle = 0.0;  ///< against the clock [degrees], a multiple of 90
  /// Of its courtyard around the middle, and the pads' places: before it is turned.
  double width = 0.0;
  double height = 0.0;
  /// Where KiCad's library has its origin, from its middle, before it is turned.
  double origin_x = 0.0, origin_y = 0.0;
  std::vector<BoardPad> pads{};

  /// The designator: R1, U1, C1, J1, TP1, H1.
  [[nodiscard]] std::string reference() const;
  [[nodiscard]] bool overloaded() const noexcept { return watt > rated_watt; }
  /// KiCad's name of it without that of its library.
  [[nodiscard]] std::string package() const;
  [[nodiscard]] bool is_bought() const noexcept { return kind < Kind::test_point; }
  /// Whether a machine places it: headers are soldered by hand.
  [[nodiscard]] bool is_placed() const noexcept { return kind < Kind::header; }
};

struct BoardTrack {
  std::size_t net = 0;
  bool back = false;  ///< on the bottom layer
  double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0;
  double width = 0.0;
};

struct BoardVia {
  std::size_t net = 0;
  double x = 0.0, y = 0.0;
};

/// On silk.
struct BoardText {
  std::string text{};
  double x = 0.0, y = 0.0;  ///< of its middle
  double angle = 0.0;       ///< [degrees]
};

struct Board {
  std::vector<std::string> nets{};  ///< nets[0] is "", no net; the others once each
  std::vector<Footprint> footprints{};
  std::vector<BoardTrack> tracks{};
  std::vector<BoardVia> vias{};
  std::vector<BoardText> texts{};
  double width = 0.0;
  double height = 0.0;
};

/// Readings and outputs have headers of two rows of pins for ribbon cables, at most 20 signals a
/// header, each with a pin of GND beside it, in the order of the circuit's sources and outputs: of
/// readings the odd pins are the signals, of outputs the even ones. A header of three pins has GND,
/// VCC and VEE. What amplifiers drive, and nodes that resistors alone join, have a test point. Nets
/// are the deck's nodes, ground is GND, and op-amps are fed by VCC and VEE. Parts of the coarsest
/// class are 0402, better ones 0603. Amplifiers are in the package that
/// `SolderedCircuit::amplifiers` names, the usual SO-8 where it names none: VOCM and an exposed pad
/// are at ground, and power-down, active low, at V+. Of a package of two op-amps one is used, and
/// the other a follower at ground. Beside the deck's parts each amplifier has a capacitor of 100 nF
/// from VCC and one from VEE to ground, and each supply one of 10 uF.
///
/// Resistors stand in rows and columns: those of a row have one net above them, those of a column
/// one below them, and both of a pair stand side by side. Headers of readings are along the upper
/// edge, amplifiers below the resistors, the other headers along the lower edge. Every net is
/// joined: along x by tracks on the top layer, along y on the bottom layer, GND by a plane on
/// In1.Cu, VCC on In2.Cu, VEE by a bus below each row of amplifiers and a wide track from there to
/// the supply's header, `supply_drop`.
///
/// Designators are numbered in the order of the circuit's resistors, of its amplifiers, of headers
/// and of the test points. Courtyards do not overlap, and leave room for the designator right of
/// each.
///
/// @throw std::invalid_argument  the circuit has other parts, or sub-circuits; two nodes have one
///                               name, or one has the supply's; the amplifiers' package has other
///                               outputs than the circuit's, or no footprint
/// @throw std::domain_error      it has no unique operating point, so that powers are not known
[[nodiscard]] Board board_of(const SolderedCircuit& soldered);

/// The project of board.kicad_pcb, board.kicad_pro, with the rules that the tracks keep: tracks of
/// 0.15 mm, clearances of 0.127 mm and vias of 0.45 mm on 0.2 mm, which most makers of boards of
/// four layers do without a surcharge.
void write_kicad_project(std::ostream& out);

/// As KiCad 6 writes it. Equal boards, equal bytes.
void write_kicad_board(std::ostream& out, const Board& board);

/// Where a machine places each part, one a row: Designator, Val, Package, Mid X, Mid Y [mm],
/// Rotation [degrees, against the clock], Layer. As KiCad's own files of positions and Gerbers have
/// it, y is up from the upper edge of KiCad's sheet.
void write_positions(std::ostream& out, const Board& board);

/// A script for the Python of KiCad 6 or newer, fabricate.py, which fills the planes of the
/// board.kicad_pcb beside it, checks it and writes Gerber and Excellon files for a maker.
[[nodiscard]] std::string_view fabrication_script() noexcept;

}  // namespace tactile_net
