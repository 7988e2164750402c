/// @file
/// A pair (K, L) in the basis where Tikhonov's method is diagonal. Private.
#pragma once

#include <Eigen/QR>
#include <Eigen/SVD>

namespace tactile_net {

/// Generalised singular values and vectors of (K, L): with the triangle R of a QR of L, whose
/// columns are independent and well conditioned, K R^-1 = U diag(gamma) V'. Nothing is squared.
struct StandardForm {
  StandardForm(const Eigen::MatrixXd& k, const Eigen::MatrixXd& l)
      : triangle(l.householderQr().matrixQR().topRows(l.cols()).triangularView<Eigen::Upper>()) {
    const Eigen::MatrixXd standard =
        triangle.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(k);
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(standard, Eigen::ComputeThinU | Eigen::ComputeThinV);
    u = svd.matrixU();
    v = svd.matrixV();
    gamma = svd.singularValues();
  }

  /// R^-1 V y: from components to tractions.
  template <class Components>
  [[nodiscard]] Eigen::MatrixXd from_components(const Components& y) const {
    return triangle.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd(v * y));
  }

  Eigen::MatrixXd triangle;  // R
  Eigen::MatrixXd u, v;
  Eigen::VectorXd gamma;  // descending
};

}  // namespace tactile_net
