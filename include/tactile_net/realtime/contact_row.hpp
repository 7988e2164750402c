/// @file
/// The contacts of a frame one by one, each with a number that stays with it.
///
///     std::array<ContactRow, 4> rows;              // as many as are wanted, the strongest first
///     ContactEstimate contact{.tractions = tractions, .rows = rows};
///     if (estimator.update(readings, contact) == FrameStatus::ok)
///       for (const ContactRow& row : contact.rows.first(contact.rows_found)) follow(row.id, row);
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace tactile_net {

/// A patch of cells that touch one another, by an edge or a corner; of a line a stretch, up to
/// where it presses least between two. Forces of a line in N/m, of a skin in N.
struct ContactRow {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// From 1 on. A contact keeps it while it shares more cells with its former self than any other
  /// does, and for two frames in which it is not seen.
  std::uint32_t id = 0;
  std::size_t cells = 0;  ///< that touch
  double normal_force = 0.0;
  double force_deviation = unknown;  ///< by noise and smoothing; NaN: not known, or one of several
                                     ///< on a line
  double tangential_y = unknown;     ///< of a line its tangential force; NaN: not solved for
  double tangential_z = unknown;     ///< of a skin
  double centre = unknown;           ///< of pressure, y [m]
  double centre_z = unknown;         ///< of a skin [m]
  double torsion = unknown;          ///< of a skin, about the centre of pressure [N m]
  double friction_margin = unknown;  ///< mu F - |drag|; NaN: mu or drag is not known
  double slip_margin = unknown;      ///< of a skin, as `ContactEstimate::slip_margin`
};

/// Rows that a frame gives at most.
inline constexpr std::size_t most_contact_rows = 16;

}  // namespace tactile_net
