#include "skin/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "skin/cosine_waves.hpp"
#include "skin/sparse_stabiliser.hpp"
#include "skin/window_sums.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// left X right', component by component, of every column, in its place: columns may be as many
/// numbers as memory holds once.
/// @pre  left and right are square
Eigen::MatrixXd along_both(Eigen::MatrixXd columns, const Eigen::MatrixXd& left,
                           const Eigen::MatrixXd& right) {
  const Index cells = left.cols() * right.cols();
  for (Index j = 0; j < columns.cols(); ++j)
    for (Index start = 0; start < columns.rows(); start += cells) {
      Eigen::Map<RowMajor> x(columns.col(j).data() + start, left.rows(), right.rows());
      x = left * x * right.transpose();
    }
  return columns;
}

/// As `edges`, which of a large skin's face would be too many numbers.
Eigen::SparseMatrix<double> sparse_edges(const SkinProblem& problem, const ActiveFace& face) {
  const std::size_t cells = problem.grid.count();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < face.free.size(); ++j) {
    const auto& [cell, along] = face.free[j];
    if (cell >= cells) throw std::invalid_argument("a face of another problem");
    for (std::size_t u = 0; u < problem.components; ++u)
      if (along[u] != 0.0)
        entries.emplace_back(static_cast<int>(u * cells + cell), static_cast<int>(j), along[u]);
  }
  Eigen::SparseMatrix<double> map(static_cast<Index>(problem.components * cells),
                                  std::ssize(face.free));
  map.setFromTriplets(entries.begin(), entries.end());
  return map;
}

}  // namespace

Eigen::VectorXd stabiliser_spectrum(const SkinProblem& problem) {
  return stabiliser_spectrum(problem, problem.tangential_weight);
}

Eigen::VectorXd stabiliser_spectrum(const SkinProblem& problem, double tangential_weight) {
  const SkinGrid& grid = problem.grid;
  const double y = problem.smoothing_length / grid.spacing_y;
  const double z = problem.smoothing_length / grid.spacing_z;
  Eigen::VectorXd spectrum(static_cast<Index>(problem.components * grid.count()));
  Index at = 0;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double weight = u == 0 ? 1.0 : tangential_weight;
    for (std::size_t m = 0; m < grid.rows; ++m)
      for (std::size_t n = 0; n < grid.columns; ++n)
        spectrum(at++) =
            problem.area * weight * weight *
            (1.0 + y * y * roughness(m, grid.rows) + z * z * roughness(n, grid.columns));
  }
  return spectrum;
}

CosineCoordinates::CosineCoordinates(const SkinProblem& problem, Eigen::VectorXd stretch)
    : y_(cosine_waves(problem.grid.rows, problem.grid.rows)),
      z_(cosine_waves(problem.grid.columns, problem.grid.columns)),
      stretch_(std::move(stretch)) {}

Eigen::MatrixXd CosineCoordinates::tractions(const Eigen::MatrixXd& coordinates) const {
  return along_both(stretch_.cwiseInverse().asDiagonal() * coordinates, y_, z_);
}

Eigen::MatrixXd CosineCoordinates::sums(Eigen::MatrixXd tractions) const {
  Eigen::MatrixXd all = along_both(std::move(tractions), y_.transpose(), z_.transpose());
  const Eigen::ArrayXd shrunk = stretch_.cwiseInverse();
  all.array().colwise() *= shrunk;
  return all;
}

Eigen::MatrixXd CosineCoordinates::coordinates(const Eigen::MatrixXd& tractions) const {
  return stretch_.asDiagonal() * along_both(tractions, y_.transpose(), z_.transpose());
}

Eigen::MatrixXd CosineCoordinates::spread(const Eigen::MatrixXd& coordinates) const {
  return along_both(stretch_.asDiagonal() * coordinates, y_, z_);
}

Eigen::VectorXd CosineCoordinates::squares() const {
  return along_both(stretch_.cwiseAbs2().cwiseInverse(), y_.cwiseAbs2(), z_.cwiseAbs2());
}

Eigen::VectorXd CosineCoordinates::squares(const SkinGrid&, const CellWindow& window) const {
  const auto sums = [](const Eigen::MatrixXd& waves, std::size_t reach) {
    Eigen::MatrixXd all = waves;
    for (Index wave = 0; wave < all.cols(); ++wave)
      window_sums(all.col(wave).data(), static_cast<std::size_t>(all.rows()), 1, reach);
    return Eigen::MatrixXd(all.cwiseAbs2());
  };
  const Index cells = y_.rows() * z_.rows();
  return along_both(stretch_.head(cells).cwiseAbs2().cwiseInverse(), sums(y_, window.rows),
                    sums(z_, window.columns));
}

FaceCoordinates::FaceCoordinates(const SkinProblem& problem, const ActiveFace& face) {
  if (face.free.empty())
    throw std::invalid_argument("every traction is held at zero: no family of any");
  edges_ = sparse_edges(problem, face);
  const double spacing = std::min(problem.grid.spacing_y, problem.grid.spacing_z);
  if (spacing > too_narrow * problem.smoothing_length) {
    const Eigen::SparseMatrix<double> stretched = sparse_stabiliser(problem) * edges_;
    root_.emplace(Eigen::SparseMatrix<double>(edges_.transpose() * stretched));
    if (root_->definite()) return;
    root_.reset();
  }
  const CosineCoordinates waves(problem, stabiliser_spectrum(problem).cwiseSqrt());
  triangle_ = HouseholderQr(waves.coordinates(Eigen::MatrixXd(edges_))).triangle();
}

Eigen::MatrixXd FaceCoordinates::tractions(const Eigen::MatrixXd& coordinates) const {
  return edges_ * (root_ ? root_->solve(coordinates) : solve_upper(triangle_, coordinates));
}

Eigen::MatrixXd FaceCoordinates::sums(Eigen::MatrixXd tractions) const {
  const Eigen::MatrixXd along = edges_.transpose() * tractions;
  if (root_) return root_->solve_transposed(along);
  return divide_upper(along.transpose(), triangle_).transpose();
}

Eigen::VectorXd FaceCoordinates::squares() const {
  // R'^-1 of the directions: a traction is along three of them at most, and along none where
  // nothing is free.
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count(), count());
  const Eigen::MatrixXd directions =
      root_ ? root_->solve_transposed(identity) : divide_upper(identity, triangle_).transpose();
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows(edges_);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(rows.rows());
  Eigen::VectorXd along(count());
  for (Index i = 0; i < rows.rows(); ++i) {
    along.setZero();
    bool free = false;
    for (decltype(rows)::InnerIterator entry(rows, i); entry; ++entry) {
      along += entry.value() * directions.col(entry.col());
      free = true;
    }
    if (free) squares(i) = along.squaredNorm();
  }
  return squares;
}

Eigen::VectorXd FaceCoordinates::squares(const SkinGrid& grid, const CellWindow& window) const {
  const auto cells = static_cast<Index>(grid.count());
  Eigen::MatrixXd windows = Eigen::MatrixXd::Zero(edges_.rows(), cells);
  windows.topRows(cells).setIdentity();
  for (Index cell = 0; cell < cells; ++cell)
    window_sums(grid, window, std::span(windows.col(cell).data(), grid.count()));
  return sums(windows).colwise().squaredNorm();
}

}  // namespace tactile_net
