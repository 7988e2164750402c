#include "grasp/space/contact_columns.hpp"

namespace tactile_net {

ContactColumns::ContactColumns(std::span<const SpaceContactPlace> places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    first.push_back(std::ssize(column));
    for (std::size_t k = 0; k < (places[i].planar ? 2U : 3U); ++k) {
      column.push_back(static_cast<Eigen::Index>(4 * i + k));
      scale.push_back(1.0);
    }
    if (!places[i].torsion_radius) continue;
    column.push_back(static_cast<Eigen::Index>(4 * i + 3));
    scale.push_back(*places[i].torsion_radius);
  }
  first.push_back(std::ssize(column));
}

Eigen::MatrixXd ContactColumns::of(const Eigen::MatrixXd& matrix) const {
  Eigen::MatrixXd own(matrix.rows(), count());
  for (Eigen::Index k = 0; k < count(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    own.col(k) = scale[at] * matrix.col(column[at]);
  }
  return own;
}

Eigen::MatrixXd ContactColumns::felt(const Eigen::MatrixXd& forces) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(4 * (std::ssize(first) - 1), forces.cols());
  for (Eigen::Index k = 0; k < count(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    all.row(column[at]) = scale[at] * forces.row(k);
  }
  return all;
}

Eigen::VectorXd ContactColumns::forces(const Eigen::VectorXd& felt) const {
  Eigen::VectorXd own(count());
  for (Eigen::Index k = 0; k < count(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    own(k) = felt(column[at]) / scale[at];
  }
  return own;
}

}  // namespace tactile_net
