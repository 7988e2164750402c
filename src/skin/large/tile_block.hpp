/// @file
/// A tile's block of P, factored in the classes into which its reflections split it. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "numeric/cholesky.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// Cells of a tile with all their tractions, component after component and row by row, and the
/// reflections that leave its block as it is.
struct TileShape {
  std::size_t components, rows, columns;
  bool mirrors_y, mirrors_z;

  [[nodiscard]] std::size_t tractions() const noexcept { return components * rows * columns; }
};

/// Tractions of which p has even or odd parity under each of a tile's reflections; q_y, being
/// turned round along y, has the other parity there, q_z along z.
struct TileClass {
  /// An orthonormal basis: of every traction its place in it and what it has there, 0 of an odd one
  /// in the middle.
  std::vector<Eigen::Index> places;
  std::vector<double> shares;
  Eigen::Index size = 0;

  /// folded = B' x, column by column. @pre  a row per place, and one per traction
  void fold(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> folded) const;
  /// x += B folded.
  void add_unfolded(const Eigen::Ref<const Eigen::MatrixXd>& folded,
                    Eigen::Ref<Eigen::MatrixXd> x) const;
  /// To the lower triangle of B' A B what A has at (a, b) and (b, a).
  void add_entry(std::size_t a, std::size_t b, double value, Eigen::MatrixXd& folded) const;
};

/// One, two or four, without those that hold nothing.
[[nodiscard]] std::vector<TileClass> tile_classes(const TileShape& shape);

/// A block by its classes: a quarter of the size each where both reflections hold, so that a solve
/// takes a quarter of the products and a factor a sixteenth.
class TileBlock {
 public:
  /// @param folded  B' A B of each class, the lower triangle
  TileBlock(std::vector<TileClass> classes, const std::vector<Eigen::MatrixXd>& folded);

  [[nodiscard]] bool is_positive_definite() const noexcept;
  /// x = A^-1 x, column by column. @pre  A is positive definite
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> x) const;

 private:
  std::vector<TileClass> classes_;
  std::vector<Cholesky> factors_;
};

}  // namespace tactile_net
