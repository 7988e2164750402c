/// @file
/// A plan's product as the loops read it. Private.
///
/// A matrix is stored in panels of a few cache lines of rows, as many as one set of instructions
/// has registers for, column after column inside a panel. So the innermost loop adds a column's
/// share to sums that stay in registers, and reads memory strictly forwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "realtime/aligned.hpp"
#include "realtime/folding.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

template <class T>
struct Panels {
  /// @param most    cache lines of rows in a panel
  /// @param beyond  the caches of a core
  Panels(const Factor& factor, std::size_t most, bool beyond);

  std::size_t columns;
  std::size_t single_rows;  // after the panels, each for itself
  bool far;                 // read ahead by software
  std::size_t panels = 0;
  std::size_t lines = 0;  // of rows, in a narrow panel; one more in those after them
  std::size_t narrow_panels = 0;
  Aligned<T> values;
};

/// What one factor, or two, multiply, and where it lies among the folded values.
struct ProductClass {
  std::size_t factor = 0;  // the first of them
  std::size_t input = 0;
  std::size_t output = 0;
  // Of (+, -) where y and z are exchanged a second vector, that of (-, +).
  bool twice = false;
  std::size_t other_input = 0;
  std::size_t other_output = 0;
};

/// A product made ready. Constant after construction.
template <class T>
struct ReadyProduct {
  /// @param most_lines   of the kernels that will use it
  /// @param most_shared  of those, where one factor multiplies two vectors
  ReadyProduct(const ProductPlan& plan, std::size_t most_lines, std::size_t most_shared);

  Structure structure;
  std::size_t rows;
  std::size_t columns;
  std::vector<Panels<T>> factors;
  std::vector<ProductClass> classes;             // without those that have no places in y
  std::optional<Folding<T>> fold_x{}, fold_y{};  // of reflections
  double scale;

  /// Scratch of one product: values of T.
  std::size_t input_size;   // all classes of x, each padded
  std::size_t middle_size;  // between two factors
  std::size_t output_size;  // all classes of y, each padded
  [[nodiscard]] std::size_t scratch_size() const noexcept {
    return input_size + middle_size + output_size;
  }
};

}  // namespace tactile_net
