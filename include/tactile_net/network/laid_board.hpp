/// @file
/// A circuit board as a file of KiCad has it: copper, layers, and what each pad is joined to.
///
///     const LaidBoard board = read_kicad_board(text, "board.kicad_pcb");
///     net_copper(board);  // copper_capacitance.hpp
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/network/amplifier_package.hpp"
#include "tactile_net/network/circuit.hpp"

namespace tactile_net {

/// Places and sizes in millimetres, angles in degrees.
struct LaidBoard {
  struct Layer {
    std::string name{};         ///< "F.Cu"
    double to_plane = 0.0;      ///< to the nearest layer that is a plane, > 0
    double permittivity = 1.0;  ///< relative, between the two
    bool inside = false;        ///< other copper on either side of it: no air above it
    bool plane = false;         ///< a zone of GND, VCC or VEE covers at least half of the board
  };
  struct Pad {
    std::string name{};
    std::size_t net = 0;
    double x = 0.0, y = 0.0, angle = 0.0;
    double width = 0.0, height = 0.0;  ///< of the rectangle around it
    bool round = false;                ///< an ellipse in that rectangle
    std::vector<bool> on{};            ///< of each layer
    double hole = 0.0;                 ///< its diameter; 0: none
  };
  struct Part {
    std::string reference{};  ///< "R12"
    std::string element{};    ///< the property Element: the deck's name; empty: none
    std::string value{};      ///< "4.99k"
    std::vector<Pad> pads{};
    std::size_t line = 0;
  };
  struct Track {
    std::size_t net = 0, layer = 0;
    double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0;
    double width = 0.0;
  };
  struct Via {
    std::size_t net = 0;
    double x = 0.0, y = 0.0;
    double size = 0.0;
    double hole = 0.0;  ///< its diameter
  };
  /// Copper of a filled zone of a net that is no supply.
  struct Area {
    std::size_t net = 0, layer = 0;
    double square_millimetres = 0.0;
    double edge = 0.0;  ///< its length
  };

  std::string file{};
  std::vector<std::string> nets{};  ///< nets[0] is "", no net
  std::vector<Layer> layers{};      ///< of copper, from the top
  double thickness = 1.6;
  double copper = 0.035;    ///< thickness of a layer
  double clearance = 0.5;   ///< of planes from what they do not join
  bool has_planes = false;  ///< false: `to_plane` is the board's thickness
  std::vector<Part> parts{};
  std::vector<Track> tracks{};
  std::vector<Via> vias{};
  std::vector<Area> areas{};
};

/// A file of KiCad 6 or newer, whoever saved it, routed or not. Blind and buried vias count as
/// whole ones.
///
/// @param file  its name, for messages
/// @throw std::invalid_argument  not such a file, cut short, or out of range: with its line
[[nodiscard]] LaidBoard read_kicad_board(std::string_view text, const std::string& file);

/// GND, VCC and VEE: nets that hold their voltage.
[[nodiscard]] bool is_supply(std::string_view net) noexcept;

/// "4.99k", "499R", "4k99" and "499" in ohms; 0: none of these.
[[nodiscard]] double resistance_of(const std::string& value);

/// Whether the board is that of this circuit: every resistor and amplifier stands on it once, with
/// the circuit's nodes on its pads, and resistors are within a sixth of the circuit's. One of the
/// circuit may be two on the board, in series or in parallel.
///
/// @param circuit     without sub-circuits
/// @param amplifiers  as `SolderedCircuit::amplifiers`
/// @throw std::invalid_argument  it is not; with the part, the net or the value that differs
void check_same_circuit(const LaidBoard& board, const Circuit& circuit,
                        const std::optional<AmplifierPackage>& amplifiers = {});

}  // namespace tactile_net
