#include "network/seen_matrix.hpp"

#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

/// S with what finite gain adds: a volt at an output takes 1/gain between the inputs.
Eigen::MatrixXd with_gain(const Reduction& reduction, const Equations& equations, double lossy) {
  Eigen::MatrixXd s = as_eigen(equations.matrix);
  if (lossy == 0.0) return s;
  Eigen::Index column = 0;
  for (Eigen::Index row = 0; row < s.rows(); ++row) {
    if (!reduction.is_amplifier(static_cast<std::size_t>(row))) continue;
    if (equations.input.values.empty())
      s(row, row) += lossy * equations.total[static_cast<std::size_t>(row)];
    else
      s.col(row) += lossy * as_eigen(equations.input).col(column++);
  }
  return s;
}

}  // namespace

SeenMatrix::SeenMatrix(const Reduction& reduction, const Equations& equations,
                       const SeenSizes& sizes, double lossy) {
  const auto [o, n, c] = sizes;
  const Eigen::MatrixXd s = with_gain(reduction, equations, lossy);
  const auto h = as_eigen(std::span(equations.right_side));
  oo = s.topLeftCorner(o, o);
  on = s.block(0, o, o, n);
  oc = s.topRightCorner(o, c);
  no = s.block(o, 0, n, o);
  nc = s.block(o, o + n, n, c);
  co = s.bottomLeftCorner(c, o);
  cn = s.block(o + n, o, c, n);
  cc = s.bottomRightCorner(c, c);
  held = s.block(o, o, n, n).diagonal();

  const Eigen::MatrixXd by_outputs = held.cwiseInverse().asDiagonal() * no;
  const Eigen::VectorXd by_sources = h.segment(o, n).cwiseQuotient(held);
  seen_ = oo - on * by_outputs;
  driven_ = h.head(o) - on * by_sources;
  if (c == 0) return;
  const Eigen::MatrixXd by_common = held.cwiseInverse().asDiagonal() * nc;
  oc_ = oc - on * by_common;
  co_ = co - cn * by_outputs;
  inverse_ = Lu(cc - cn * by_common).inverse();
  const Eigen::VectorXd sources = h.tail(c) - cn * by_sources;
  seen_ -= oc_ * (inverse_ * co_);
  driven_ -= oc_ * (inverse_ * sources);
}

Eigen::MatrixXd SeenMatrix::rows() const {
  Eigen::MatrixXd all(oo.rows(), oo.rows() + on.cols() + cc.rows());
  for (Eigen::Index i = 0; i < oo.rows(); ++i)
    all.row(i) = rows(Eigen::VectorXd::Unit(oo.rows(), i)).transpose();
  return all;
}

Eigen::MatrixXd SeenMatrix::unknowns() const {
  Eigen::MatrixXd all(oo.rows() + on.cols() + cc.rows(), oo.rows());
  for (Eigen::Index i = 0; i < oo.rows(); ++i)
    all.col(i) = unknowns(Eigen::VectorXd::Unit(oo.rows(), i));
  return all;
}

Eigen::VectorXd SeenMatrix::rows(const Eigen::VectorXd& x) const {
  Eigen::VectorXd all(oo.rows() + on.cols() + cc.rows());
  Eigen::VectorXd residual = on.transpose() * x;
  if (cc.rows() > 0) {
    const Eigen::VectorXd common = -(inverse_.transpose() * (oc_.transpose() * x));
    residual += cn.transpose() * common;
    all.tail(cc.rows()) = common;
  }
  all.head(oo.rows()) = x;
  all.segment(oo.rows(), on.cols()) = -residual.cwiseQuotient(held);
  return all;
}

Eigen::VectorXd SeenMatrix::unknowns(const Eigen::VectorXd& x) const {
  Eigen::VectorXd all(oo.rows() + on.cols() + cc.rows());
  Eigen::VectorXd residual = no * x;
  if (cc.rows() > 0) {
    const Eigen::VectorXd common = -(inverse_ * (co_ * x));
    residual += nc * common;
    all.tail(cc.rows()) = common;
  }
  all.head(oo.rows()) = x;
  all.segment(oo.rows(), on.cols()) = -residual.cwiseQuotient(held);
  return all;
}

}  // namespace tactile_net
