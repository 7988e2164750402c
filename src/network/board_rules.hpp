/// @file
/// The design rules of a board: its tracks keep them, and board.kicad_pro states them. Private.
#pragma once

/// In millimetres; what most makers of boards of four layers do without a surcharge.
namespace tactile_net::board_rules {

inline constexpr double clearance = 0.127;
inline constexpr double track = 0.15;
inline constexpr double wide_track = 0.3;    // to the vias of planes, at most
inline constexpr double supply_track = 1.2;  // of the supply that has no plane
inline constexpr double via = 0.45;
inline constexpr double via_drill = 0.2;
inline constexpr double pin_drill = 1.0;
inline constexpr double plane_clearance = 0.3;
inline constexpr double plane_from_edge = 0.5;

// What a maker can do at the least.
inline constexpr double least_track = 0.127;
inline constexpr double least_via = 0.4;
inline constexpr double least_ring = 0.1;
inline constexpr double hole_to_hole = 0.25;
inline constexpr double hole_to_copper = 0.2;
inline constexpr double copper_to_edge = 0.3;

inline constexpr double silk_height = 0.8;
inline constexpr double silk_line = 0.1;

}  // namespace tactile_net::board_rules
