#include "inverse/damped_bidiagonal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net {

using Eigen::Index;

DampedBidiagonal::DampedBidiagonal(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& above,
                                   Eigen::VectorXd alphas)
    : alphas_(std::move(alphas)) {
  const Index count = alphas_.size();
  const Index n = diagonal.size();
  for (Eigen::MatrixXd* const all : {&diagonal_, &above_, &cosine_, &sine_, &stay_, &pass_})
    all->resize(count, n);
  Eigen::VectorXd damping2 = alphas_;  // the square of what stands below the diagonal number
  for (Index i = 0; i < n; ++i) {
    const double d = diagonal(i);
    const double beside = i + 1 < n ? above(i) : 0.0;
    for (Index a = 0; a < count; ++a) {
      const double size = std::sqrt(d * d + damping2(a));
      const double inverse = 1.0 / size;
      const double c = d * inverse;
      const double s = std::sqrt(damping2(a)) * inverse;
      const double passed = s * beside;
      const double next2 = alphas_(a) + passed * passed;
      const double over = 1.0 / std::sqrt(next2);
      diagonal_(a, i) = size;
      above_(a, i) = c * beside;
      cosine_(a, i) = c;
      sine_(a, i) = s;
      stay_(a, i) = std::sqrt(alphas_(a)) * over;
      pass_(a, i) = passed * over;
      damping2(a) = next2;
    }
  }
}

Eigen::VectorXd DampedBidiagonal::log_determinants() const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(alphas_.size());
  for (Index i = 0; i < size(); ++i)
    all.array() -= (diagonal_.col(i).array().square() / alphas_.array()).log();
  return all;
}

Eigen::VectorXd DampedBidiagonal::traces() const {
  // From the last on, the diagonal of (R'R)^-1: all of its terms are positive.
  Eigen::ArrayXd next = Eigen::ArrayXd::Zero(alphas_.size());
  Eigen::ArrayXd all = Eigen::ArrayXd::Zero(alphas_.size());
  for (Index i = size(); i-- > 0;) {
    next = (1.0 + above_.col(i).array().square() * next) / diagonal_.col(i).array().square();
    all += 1.0 - alphas_.array() * next;
  }
  return all;
}

Eigen::MatrixXd DampedBidiagonal::left(const Eigen::MatrixXd& rotated) const {
  const Index count = alphas_.size();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count, rotated.cols());
  Eigen::VectorXd below(count);
  for (Index k = 0; k < rotated.cols(); ++k) {
    below.setZero();
    double* const q = all.col(k).data();
    double* const carried = below.data();
    for (Index i = 0; i < size(); ++i) {
      const double g = rotated(i, k);
      const double* const c = cosine_.col(i).data();
      const double* const s = sine_.col(i).data();
      const double* const stay = stay_.col(i).data();
      const double* const pass = pass_.col(i).data();
      for (Index a = 0; a < count; ++a) {
        const double rest = c[a] * carried[a] - s[a] * g;
        q[a] += stay[a] * rest * (stay[a] * rest);
        carried[a] = -pass[a] * rest;
      }
    }
  }
  return all;
}

Eigen::MatrixXd DampedBidiagonal::filtered(const Eigen::VectorXd& rotated) const {
  const Index count = alphas_.size();
  Eigen::ArrayXXd right(count, size());
  Eigen::ArrayXd below = Eigen::ArrayXd::Zero(count);
  for (Index i = 0; i < size(); ++i) {
    const double g = rotated(i);
    right.col(i) = cosine_.col(i).array() * g + sine_.col(i).array() * below;
    below = -pass_.col(i).array() * (cosine_.col(i).array() * below - sine_.col(i).array() * g);
  }
  Eigen::ArrayXd next = Eigen::ArrayXd::Zero(count);
  for (Index i = size(); i-- > 0;)
    right.col(i) = next = (right.col(i) - above_.col(i).array() * next) / diagonal_.col(i).array();
  return right.matrix().transpose();
}

Eigen::MatrixXd DampedBidiagonal::spreads(const Eigen::MatrixXd& sums) const {
  constexpr Index together = 128;  // rows: what they need of a column stays near
  constexpr Index few = 8;
  Eigen::MatrixXd all(sums.rows(), alphas_.size());
  if (sums.rows() < few) {
    for (Index k = 0; k < all.rows(); ++k) all.row(k) = products(sums.row(k), sums.row(k));
    return all;
  }
  Eigen::VectorXd solved(together);
  for (Index first = 0; first < sums.rows(); first += together) {
    const Index rows = std::min(together, sums.rows() - first);
    for (Index a = 0; a < all.cols(); ++a) {
      double* const z = solved.data();
      double* const sum = all.col(a).data() + first;
      std::fill_n(z, rows, 0.0);
      std::fill_n(sum, rows, 0.0);
      double before = 0.0;  // the number above the diagonal one
      for (Index i = 0; i < size(); ++i) {
        const double* const s = sums.col(i).data() + first;
        const double over = 1.0 / diagonal_(a, i);
        for (Index k = 0; k < rows; ++k) {
          z[k] = (s[k] - before * z[k]) * over;
          sum[k] += z[k] * z[k];
        }
        before = above_(a, i);
      }
    }
  }
  return all;
}

Eigen::RowVectorXd DampedBidiagonal::products(const Eigen::RowVectorXd& a,
                                              const Eigen::RowVectorXd& b) const {
  Eigen::ArrayXd one = Eigen::ArrayXd::Zero(alphas_.size());
  Eigen::ArrayXd other = one;
  Eigen::ArrayXd all = one;
  Eigen::ArrayXd before = one;
  for (Index i = 0; i < size(); ++i) {
    one = (a(i) - before * one) / diagonal_.col(i).array();
    other = (b(i) - before * other) / diagonal_.col(i).array();
    all += one * other;
    before = above_.col(i).array();
  }
  return all.matrix().transpose();
}

}  // namespace tactile_net
