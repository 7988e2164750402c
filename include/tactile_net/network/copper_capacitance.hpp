/// @file
/// What the copper of a board loads a circuit's nodes with, by closed formulas.
///
///     const std::vector<NetCopper> nets = net_copper(read_kicad_board(text, "board.kicad_pcb"));
///     nets[0].farad();
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/laid_board.hpp"

namespace tactile_net {

/// Over a plane. Lengths in any one unit.
struct Microstrip {
  double height = 0.0;        ///< over the plane, > 0
  double permittivity = 1.0;  ///< relative, of what is between, >= 1
  double thickness = 0.0;     ///< of the copper, >= 0
  bool covered = false;       ///< the same dielectric above it, in place of air

  /// Of a track of that width, > 0 [F/m]: Hammerstad and Jensen (1980), within 1 % of the exact
  /// static one for widths from a hundredth to a hundred of the height.
  [[nodiscard]] double capacitance(double width) const;

  /// The same less that of the plates alone, of one of its two edges [F/m].
  [[nodiscard]] double edge_capacitance(double width) const;

  /// Of a rectangle of copper [F], lengths in metres: its area as a plate, eps A / h, and at each
  /// edge what a track as wide as the rectangle has there.
  [[nodiscard]] double plate_capacitance(double width, double length) const;
};

/// A hole's copper through planes, from which it keeps a clearance [F], lengths in metres:
/// 55.5 pF/m permittivity thickness pad / (2 clearance) (Johnson and Graham 1993).
[[nodiscard]] double hole_capacitance(double pad, double clearance, double thickness,
                                      double permittivity);

/// What a net is made of, to ground: neighbours are taken for planes.
struct NetCopper {
  std::string net{};
  std::size_t pads = 0;
  double of_pads = 0.0;     ///< [F]
  double of_tracks = 0.0;   ///< [F], areas and vias included
  double of_missing = 0.0;  ///< [F], of tracks that are yet to be laid
  double length = 0.0;      ///< of tracks [mm]
  /// Of the tracks that are missing [mm]: the shortest tree, along x and y, of what is not joined
  /// yet.
  double missing = 0.0;

  [[nodiscard]] double farad() const noexcept { return of_pads + of_tracks + of_missing; }
};

/// Of missing tracks [mm].
inline constexpr double usual_width = 0.15;

/// Every net that has a pad but those that hold their voltage, `is_supply`, in the board's order.
///
/// @throw std::invalid_argument  more than 20,000 tracks or pads on one net
[[nodiscard]] std::vector<NetCopper> net_copper(const LaidBoard& board);

/// A node's capacitance to ground.
struct NodeCapacitance {
  std::string node{};
  double farad = 0.0;  ///< > 0
};

/// The nodes' capacitances of a circuit whose resistors may be two on the board. Where these are in
/// series, the node between them is none of the circuit's: as much of its capacitance is at either
/// end as has the smaller resistance to it, which is exact to first order in frequency but for what
/// couples the two ends.
///
/// @param circuit     without sub-circuits
/// @param amplifiers  as `SolderedCircuit::amplifiers`
/// @throw std::invalid_argument  as `check_same_circuit`
[[nodiscard]] std::vector<NodeCapacitance> node_capacitances(
    const LaidBoard& board, std::span<const NetCopper> copper, const Circuit& circuit,
    const std::optional<AmplifierPackage>& amplifiers = {});

/// The circuit with a capacitor Cb and the node's name each from these nodes to ground.
///
/// @throw std::invalid_argument  the circuit has no node of that name, or a value is not > 0
[[nodiscard]] Circuit with_capacitances(Circuit circuit,
                                        std::span<const NodeCapacitance> capacitances);

}  // namespace tactile_net
