/// @file
/// A grasp's contact forces as one vector in newtons: three of a hard contact, two of a planar
/// one, and of a soft one torsion over its radius too. Private.
#pragma once

#include <span>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"

namespace tactile_net {

/// Which of the four columns of a `SpaceMap` a contact has, and their scale.
struct ContactColumns {
  explicit ContactColumns(std::span<const SpaceContactPlace> places);

  std::vector<Eigen::Index> column;  ///< of each force, among 4 contacts
  std::vector<double> scale;         ///< what a force of 1 N is there: 1, of torsion the radius
  std::vector<Eigen::Index> first;   ///< force of each contact; at the end: how many there are

  [[nodiscard]] Eigen::Index count() const { return first.back(); }
  [[nodiscard]] Eigen::Index count(std::size_t contact) const {
    return first[contact + 1] - first[contact];
  }
  /// A matrix of 4 contacts' columns, in these forces.
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& matrix) const;
  /// From these forces to 4 contacts' values, and back.
  [[nodiscard]] Eigen::MatrixXd felt(const Eigen::MatrixXd& forces) const;
  [[nodiscard]] Eigen::VectorXd forces(const Eigen::VectorXd& felt) const;
};

}  // namespace tactile_net
