#include "inverse/face_coordinates.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "inverse/sparse_stabiliser.hpp"
#include "inverse/window_sums.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// The directions of a face as columns, tractions x directions.
Eigen::SparseMatrix<double> sparse_edges(const LinearProblem& problem, const ActiveFace& face) {
  const std::size_t cells = problem.grid.count();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < face.free.size(); ++j) {
    const auto& [cell, along] = face.free[j];
    if (cell >= cells)
      throw std::invalid_argument("the face is of another problem: it has a cell beyond the grid");
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

FaceCoordinates::FaceCoordinates(const LinearProblem& problem, const ActiveFace& face) {
  if (face.free.empty())
    throw std::invalid_argument(
        "every traction is held at zero, so that there is nothing to make a family of: ask for one "
        "where the face has a free direction");
  edges_ = sparse_edges(problem, face);
  const SurfaceGrid& grid = problem.grid;
  const double spacing =
      grid.columns == 1 ? grid.spacing_y : std::min(grid.spacing_y, grid.spacing_z);
  if (spacing > too_narrow * problem.smoothing_length) {
    const Eigen::SparseMatrix<double> stretched = sparse_stabiliser(problem) * edges_;
    root_.emplace(Eigen::SparseMatrix<double>(edges_.transpose() * stretched));
    if (root_->definite()) return;
    root_.reset();
  }
  const WaveCoordinates waves(problem, stabiliser_spectrum(problem).cwiseSqrt());
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

Eigen::VectorXd FaceCoordinates::squares(const SurfaceGrid& grid, const CellWindow& window) const {
  const auto cells = static_cast<Index>(grid.count());
  Eigen::MatrixXd windows = Eigen::MatrixXd::Zero(edges_.rows(), cells);
  windows.topRows(cells).setIdentity();
  for (Index cell = 0; cell < cells; ++cell)
    window_sums(grid, window, std::span(windows.col(cell).data(), grid.count()));
  return sums(windows).colwise().squaredNorm();
}

}  // namespace tactile_net
