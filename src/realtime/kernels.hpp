/// @file
/// The loops of a frame, each compiled once for every instruction set. Private.
///
/// A matrix is stored in panels of a few cache lines of rows, as many as one set of instructions
/// has registers for, column after column inside a panel. So the innermost loop adds a column's
/// share to sums that stay in registers, and reads memory strictly forwards.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "realtime/aligned.hpp"
#include "realtime/folding.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

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

/// A product made ready. Constant after construction.
template <class T>
struct ReadyProduct {
  /// @param most_lines   of the kernels that will use it
  /// @param most_shared  of those, where one factor multiplies two vectors
  ReadyProduct(const ProductPlan& plan, std::size_t most_lines, std::size_t most_shared);

  Structure structure;
  std::size_t rows;
  std::size_t columns;
  std::vector<std::int8_t> row_signs;
  std::vector<std::int8_t> column_signs;
  std::size_t row_block;  // values to a sign
  std::size_t column_block;
  std::vector<Panels<T>> factors;
  std::optional<Folding<T>> fold_x{}, fold_y{};  // of reflections
  double scale;

  /// Scratch of one product: values of T.
  std::size_t input_size;  // both classes of x, each padded
  std::size_t even_input_size = 0;
  std::size_t middle_size;  // between two factors
  std::size_t output_size;  // both classes of y, each padded
  std::size_t even_output_size = 0;
  [[nodiscard]] std::size_t scratch_size() const noexcept {
    return input_size + middle_size + output_size;
  }
};

struct Moments {
  double sum = 0.0;    // sum f_j
  double first = 0.0;  // sum (j - (n - 1) / 2) f_j
};

struct Misfit {
  double sum_of_squares = 0.0;  // of the weighted residuals
  double objective = 0.0;       // weighted readings times weighted residuals: Tikhonov's minimum
  double size = 0.0;            // sum of squares of the weighted readings
  std::uint64_t largest = 0;    // bits of the largest r_i^2 share_i
};

/// The loops for one instruction set.
struct Kernels {
  std::size_t most_lines;   // of a panel
  std::size_t most_shared;  // of one that multiplies two vectors
  /// x = g - baseline; returns `largest(x)`.
  std::uint64_t (*subtract)(const double* g, const double* baseline, double* x,
                            std::size_t n) noexcept;
  /// Bits of the largest |x|, which order as the doubles do, NaN last.
  std::uint64_t (*largest)(const double* x, std::size_t n) noexcept;
  /// y = A x; `magnitude`: 2^k >= |x| / 2 of every entry, by which float sums are scaled. Moments
  /// of as many blocks of y as there is room for: none or all. y may be the memory of x.
  /// @return false, and y is untouched: an |x| is NaN or beyond `limit`, as `largest` has it
  bool (*multiply64)(const ReadyProduct<double>& a, Difference x, double* y, double* scratch,
                     double magnitude, std::span<Moments> moments, std::uint64_t limit) noexcept;
  bool (*multiply32)(const ReadyProduct<float>& a, Difference x, double* y, float* scratch,
                     double magnitude, std::span<Moments> moments, std::uint64_t limit) noexcept;
  double (*dot)(const double* a, const double* b, std::size_t n) noexcept;
  /// spread_i = (w_i (x_i - p_i))^2 share_i
  Misfit (*misfit)(const double* x, const double* p, const double* weights, const double* shares,
                   double* spread, std::size_t n) noexcept;
};

/// The power of two below the largest |x|: of its bits, the exponent.
[[nodiscard]] inline double magnitude_of(const Kernels& loops, const double* x,
                                         std::size_t n) noexcept {
  const std::uint64_t exponent = loops.largest(x, n) & 0x7ff0'0000'0000'0000U;
  return std::bit_cast<double>(std::clamp(exponent, std::bit_cast<std::uint64_t>(0x1p-1021),
                                          std::bit_cast<std::uint64_t>(0x1p1021)));
}

/// @param set  one that this machine runs
[[nodiscard]] const Kernels& kernels(InstructionSet set) noexcept;

}  // namespace tactile_net
