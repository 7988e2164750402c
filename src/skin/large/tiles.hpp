/// @file
/// An approximate inverse of P = K' W^2 K + alpha L'L by overlapping tiles of the grid, whose
/// blocks are factored in the classes into which their reflections split them. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "numeric/cholesky.hpp"
#include "numeric/eigen.hpp"
#include "skin/large/system.hpp"

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

/// The sum over tiles of the inverse of each tile's own block of P, all components together
/// (additive Schwarz; Dryja and Widlund 1987). What a reading tells of a traction lies within a few
/// depths, and so does P: half a tile of overlap needs no coarse grid.
///
/// A block holds the taxels in reach. Away from the grid's ends all blocks are equal, and those at
/// opposite ends mirror each other: few kinds are factored, those that mirror themselves by their
/// classes. A dead taxel is a change of low rank, which its tiles take into account without factors
/// of their own.
class SkinTiles {
 public:
  struct Size {
    std::size_t cells = 16;  ///< along a tile's side
    std::size_t reach = 4;   ///< to which taxels beyond it count [cells]
  };

  /// @throw std::invalid_argument  rounding makes a block indefinite: alpha is too small
  SkinTiles(const LargeSkinSystem& system, double alpha, const Size& size);

  /// z = M x. @pre  a value per traction
  void apply(std::span<const double> x, std::span<double> z);

  [[nodiscard]] std::size_t tiles() const noexcept { return tiles_.size(); }
  /// Factored.
  [[nodiscard]] std::size_t kinds() const noexcept { return kinds_.size(); }

 private:
  /// A tile along one axis, seen from its first cell or, mirrored, from its last.
  struct Line {
    bool at_start = false, at_end = false;  // of the grid
    std::vector<std::ptrdiff_t> taxels{};   // cells from the tile's first
    bool mirrored = false;                  // not part of the kind, here and below
    bool mirrors_itself = false;
  };
  struct Kind {
    Line y, z;
    TileBlock block;
  };
  /// (A - U'U)^-1 = A^-1 + Y (1 - U Y)^-1 Y', Y = A^-1 U', U: the rows of dead taxels.
  struct Dead {
    Eigen::MatrixXd images;  // Y
    Cholesky core;           // 1 - U Y
  };
  struct Tile {
    std::size_t row, column;  // of its first cell
    bool mirrored_y, mirrored_z;
    std::optional<Dead> dead;
    std::size_t kind;
  };

  /// @param most  cells along a tile's side, if the grid has more
  [[nodiscard]] static std::size_t side(std::size_t cells, std::size_t stride, std::size_t most);
  [[nodiscard]] static std::vector<std::size_t> starts(std::size_t cells, std::size_t side,
                                                       std::size_t stride);
  [[nodiscard]] Line line(std::size_t start, std::size_t side, std::size_t cells,
                          std::size_t margin, std::size_t stride, std::size_t taxels) const;
  [[nodiscard]] std::size_t kind_of(const Line& y, const Line& z);
  /// W K of a taxel (row, column, from the tile's first cell) and channel, for the tile's cells.
  void kernel_row(std::size_t channel, std::ptrdiff_t row, std::ptrdiff_t column,
                  Eigen::Ref<Eigen::VectorXd> entries) const;
  [[nodiscard]] TileBlock block(const Line& y, const Line& z) const;
  /// To what each class has of a block.
  void add_stabiliser(const Line& y, const Line& z, std::span<const TileClass> classes,
                      std::span<Eigen::MatrixXd> folded) const;
  void account_for_dead(Tile& tile, const std::vector<bool>& dead) const;
  /// Where a tile's value is among all tractions, and with which sign.
  template <typename Each>
  void visit(const Tile& tile, Each&& each) const;

  const LargeSkinSystem& system_;
  double alpha_;
  std::size_t rows_, columns_;  // of a tile
  std::size_t reach_;
  std::vector<double> channel_weights_;
  std::vector<Kind> kinds_;
  std::vector<Tile> tiles_;  // sorted by kind
  Eigen::MatrixXd values_;   // of some tiles at a time
};

}  // namespace tactile_net
