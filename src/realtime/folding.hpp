/// @file
/// Vectors of grids in the classes of two reflections; see product_plan.hpp. Private.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "realtime/aligned.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// What the reflections make of a class: +1 leave it, -1 negate it.
struct GridClass {
  int y = 1;
  int z = 1;
};
inline constexpr std::array<GridClass, 4> grid_classes{{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// Sums or differences of a line of so many values.
[[nodiscard]] constexpr std::size_t half_of(std::size_t count, int parity) noexcept {
  return parity > 0 ? count - count / 2 : count / 2;
}

/// A block's places in a class.
struct HalfGrid {
  std::size_t rows = 0;
  std::size_t columns = 0;
};
[[nodiscard]] inline HalfGrid half_grid(const GridBlocks& grid, std::size_t block,
                                        GridClass of) noexcept {
  return {half_of(grid.rows, grid.signs_y[block] * of.y),
          half_of(grid.columns, grid.signs_z[block] * of.z)};
}

[[nodiscard]] std::size_t class_size(const GridBlocks& grid, GridClass of) noexcept;

/// Places that exchanging y and z leaves alone. @pre  partners
[[nodiscard]] std::size_t places_on_diagonal(const GridBlocks& grid, GridClass of) noexcept;

/// Of each place of a class where exchanging y and z brings it: of (+, -) the place in (-, +), and
/// the other way. @pre  partners
[[nodiscard]] std::vector<std::uint32_t> exchanged_places(const GridBlocks& grid, GridClass of);

/// a - b, computed at each use. Storing it first would be slower: vector loads that overlap several
/// narrower, recent stores cannot be forwarded by the processor.
struct Difference {
  const double* a;
  const double* b;
  [[nodiscard]] double operator[](std::size_t i) const noexcept { return a[i] - b[i]; }
};

/// Where the sums and differences of a block lie, by the parities of rows and values.
template <class Place>
struct Quarters {
  Place plus_plus;
  Place plus_minus;
  Place minus_plus;
  Place minus_minus;
};

/// Classes of one side of a product, as its factors take them: where each place of a vector goes.
/// Constant after construction. The loops are in fold_loops.hpp.
template <class T>
class Folding {
 public:
  explicit Folding(const GridBlocks& grid);

  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  /// Of each block, among the folded values.
  [[nodiscard]] const std::vector<Quarters<std::size_t>>& blocks() const noexcept {
    return blocks_;
  }
  [[nodiscard]] bool exchanges() const noexcept { return offsets_.size() == 5; }
  /// Whether sums and differences of rows are all there is to it.
  [[nodiscard]] bool is_line() const noexcept { return is_line_; }

  /// As `class_sizes`; with partners class 2 has a second vector, that of (-, +) exchanged.
  [[nodiscard]] std::size_t classes() const noexcept { return offsets_.size(); }
  /// Where a class begins among the folded values.
  [[nodiscard]] std::size_t offset(std::size_t of) const noexcept { return offsets_[of]; }
  /// Of the second vector of class 2.
  [[nodiscard]] std::size_t second_offset() const noexcept { return second_; }
  /// Values of T that folding and its way back write: the folded ones, and what comes between.
  [[nodiscard]] std::size_t scratch_size() const noexcept { return size_; }

  /// From the classes of the reflections to those of the exchange, and back. @pre  partners
  void part_exchanged(T* folded) const noexcept;
  void join_exchanged(T* folded) const noexcept;

  void for_each_array(auto& use) const {
    use(blocks_);
    use(offsets_);
    use(transposed_);
    for (const Exchange& exchange : exchanges_) {
      use(exchange.first);
      use(exchange.second);
      use(exchange.alone);
    }
  }

 private:
  struct Exchange {  // of one class
    std::vector<std::uint32_t> first{}, second{}, alone{};
  };

  std::size_t rows_;
  std::size_t columns_;
  bool is_line_ = false;
  std::vector<Quarters<std::size_t>> blocks_{};
  std::array<std::size_t, 4> reflected_{};  // where each class of the reflections begins
  std::vector<std::size_t> offsets_{};
  std::size_t second_ = 0;
  std::size_t size_ = 0;
  std::array<Exchange, 2> exchanges_{};      // of (+, +) and (-, -)
  std::vector<std::uint32_t> transposed_{};  // of each place of (-, +) that in (+, -)
};

extern template class Folding<double>;
extern template class Folding<float>;

}  // namespace tactile_net
