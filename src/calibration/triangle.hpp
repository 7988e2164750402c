/// @file
/// Rows of a least-squares problem taken into a triangle, some at a time. Private.
#pragma once

#include <algorithm>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// Rows that are gathered before they are taken into the triangle: a blocked QR is fast on many.
inline constexpr Eigen::Index gathered_rows = 512;

/// Householder's reflections of the first columns, on all rows.
inline void eliminate_columns(Eigen::MatrixXd& matrix, Eigen::Index columns) {
  for (Eigen::Index c = 0; c < columns; ++c) {
    const Eigen::Index below = matrix.rows() - c;
    auto column = matrix.col(c).tail(below);
    const double length = column.norm();
    if (length == 0.0) continue;
    Eigen::VectorXd mirror = column;
    mirror(0) += mirror(0) < 0.0 ? -length : length;
    const double square = mirror.squaredNorm();
    auto rest = matrix.bottomRightCorner(below, matrix.cols() - c);
    const Eigen::RowVectorXd along = (2.0 / square) * (mirror.transpose() * rest);
    rest -= mirror * along;
  }
}

/// Rows [A | b] that became a triangle so far.
class Triangle {
 public:
  explicit Triangle(Eigen::Index columns)
      : stack_(Eigen::MatrixXd::Zero(columns + gathered_rows, columns)), top_(columns) {}

  void add(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
    for (Eigen::Index done = 0; done < rows.rows();) {
      const Eigen::Index part = std::min(rows.rows() - done, stack_.rows() - top_);
      stack_.middleRows(top_, part) = rows.middleRows(done, part);
      top_ += part;
      done += part;
      if (top_ == stack_.rows()) fold();
    }
  }
  [[nodiscard]] Eigen::MatrixXd take() {
    fold();
    return stack_.topRows(stack_.cols());
  }

 private:
  void fold() {
    const Eigen::Index columns = stack_.cols();
    const Eigen::MatrixXd r = HouseholderQr(Eigen::MatrixXd(stack_.topRows(top_))).triangle();
    stack_.setZero();
    stack_.topRows(columns) = r.triangularView<Eigen::Upper>();
    top_ = columns;
  }

  Eigen::MatrixXd stack_;
  Eigen::Index top_;
};

}  // namespace tactile_net
