#include "calibration/press_design.hpp"

#include <algorithm>
#include <utility>

#include "calibration/triangle.hpp"
#include "numeric/cholesky.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t most_exchanges = 4;  // rounds
constexpr double dependent = 1e-10;        // of a column's length, that the others leave of it

/// An orthonormal basis of the columns: Gram and Schmidt, twice.
Eigen::MatrixXd basis_of(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd basis(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    Eigen::VectorXd column = columns.col(c);
    const double length = column.norm();
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd along = basis.leftCols(rank).transpose() * column;
      column -= basis.leftCols(rank) * along;
    }
    const double left = column.norm();
    if (left > dependent * length) basis.col(rank++) = column / left;
  }
  return basis.leftCols(rank);
}

}  // namespace

PressDesign::PressDesign(Eigen::MatrixXd root, Eigen::MatrixXd aims)
    : root_(std::move(root)), aims_(std::move(aims)) {
  set({});
}

void PressDesign::add_candidate(const PressPart& rows) {
  candidates_.push_back({rows.common.sparseView(), rows.own});
}

void PressDesign::set(const std::vector<std::size_t>& chosen) {
  Triangle triangle(root_.cols());
  triangle.add(root_);
  for (const std::size_t i : chosen) {
    const Eigen::Index own = candidates_[i].own.cols();
    Eigen::MatrixXd rows(candidates_[i].own.rows(), own + root_.cols());
    rows << candidates_[i].own, Eigen::MatrixXd(candidates_[i].common);
    eliminate_columns(rows, own);
    triangle.add(rows.bottomRightCorner(rows.rows() - own, root_.cols()));
  }
  const Eigen::MatrixXd inverse =
      solve_upper(triangle.take(), Eigen::MatrixXd::Identity(root_.cols(), root_.cols()));
  covariance_ = inverse * inverse.transpose();
  const Eigen::MatrixXd along = aims_ * inverse;
  aimed_ = inverse * along.transpose();
  value_ = along.squaredNorm();
}

double PressDesign::gain(std::size_t i) const {
  const Candidate& press = candidates_[i];
  const Eigen::MatrixXd known = press.common * covariance_;
  Eigen::MatrixXd variance = known * press.common.transpose();
  variance.diagonal().array() += 1.0;
  const Cholesky factor(variance);
  const Eigen::MatrixXd taken = factor.solve_lower(press.common * aimed_);
  const Eigen::MatrixXd basis = basis_of(factor.solve_lower(press.own));
  return taken.squaredNorm() - (basis.transpose() * taken).squaredNorm();
}

std::size_t PressDesign::best() const {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (const double here = gain(i); here > most * (1.0 + 1e-9)) {
      most = here;
      best = i;
    }
  return best;
}

std::vector<std::size_t> choose(PressDesign& design, std::size_t count,
                                const std::function<void(std::size_t)>& watch) {
  std::size_t searches = 0;
  const auto best = [&] {
    if (watch) watch(++searches);
    return design.best();
  };
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k) {
    chosen.push_back(best());
    design.set(chosen);
  }
  for (std::size_t round = 0; round < most_exchanges; ++round) {
    bool changed = false;
    for (std::size_t& one : chosen) {
      const double before = design.value();
      const std::size_t old = one;
      std::vector<std::size_t> others;
      for (const std::size_t& other : chosen)
        if (&other != &one) others.push_back(other);
      design.set(others);
      one = best();
      design.set(chosen);
      if (design.value() < before * (1.0 - 1e-6)) {
        changed = true;
      } else {
        one = old;
        design.set(chosen);
      }
    }
    if (!changed) break;
  }
  std::vector<std::size_t> order;
  while (!chosen.empty()) {
    design.set(order);
    const auto next = std::max_element(
        chosen.begin(), chosen.end(),
        [&](std::size_t a, std::size_t b) { return design.gain(a) < design.gain(b); });
    order.push_back(*next);
    chosen.erase(next);
  }
  design.set(order);
  return order;
}

}  // namespace tactile_net
