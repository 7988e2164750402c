/// @file
/// A large skin's readings of tractions in coordinates. Private.
#pragma once

#include "inverse/coordinates.hpp"
#include "numeric/eigen.hpp"
#include "skin/large/system.hpp"

namespace tactile_net {

/// A = W K T, with f = T c.
struct CoordinateProducts {
  /// A c.
  [[nodiscard]] Eigen::VectorXd readings(const Eigen::VectorXd& c) const {
    const Eigen::VectorXd tractions = coordinates.tractions(c);
    Eigen::VectorXd read(eigen_index(system.readings()));
    system.weighted_readings(as_span(tractions), as_span(read));
    return read;
  }
  /// A' u.
  [[nodiscard]] Eigen::VectorXd sums(const Eigen::VectorXd& u) const {
    Eigen::VectorXd of_tractions(eigen_index(system.tractions()));
    system.weighted_sums(as_span(u), as_span(of_tractions));
    return coordinates.sums(of_tractions);
  }

  LargeSkinSystem& system;  // its buffers are used, not its meaning changed
  const TractionCoordinates& coordinates;
};

}  // namespace tactile_net
