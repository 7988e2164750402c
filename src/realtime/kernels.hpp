/// @file
/// The loops of a frame, each compiled once for every instruction set. Private.
///
/// A matrix is stored in panels of 4, 2 or 1 cache lines of rows, column after column inside a
/// panel. So the innermost loop adds a column's share to sums that stay in registers, reads memory
/// strictly forwards, and takes every sum in the order of the columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "realtime/aligned.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

template <class T>
struct Panels {
  explicit Panels(const Factor& factor);

  std::size_t rows;
  std::size_t columns;
  Aligned<T> values;
};

/// A product made ready. Constant after construction.
template <class T>
struct ReadyProduct {
  explicit ReadyProduct(const ProductPlan& plan);

  Structure structure;
  std::size_t rows;
  std::size_t columns;
  std::vector<std::int8_t> row_signs;
  std::vector<std::int8_t> column_signs;
  std::vector<Panels<T>> factors;
  double scale;

  /// Scratch of one product: values of T.
  std::size_t input_size;   // both classes of x, each padded
  std::size_t middle_size;  // between two factors
  std::size_t output_size;  // both classes of y, each padded
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
  /// x = g - baseline
  void (*subtract)(const double* g, const double* baseline, double* x, std::size_t n) noexcept;
  /// Bits of the largest |x|, which order as the doubles do, NaN last.
  std::uint64_t (*largest)(const double* x, std::size_t n) noexcept;
  /// y = A x; `magnitude`: 2^k >= |x| / 2 of every entry, by which float sums are scaled.
  void (*multiply64)(const ReadyProduct<double>& a, const double* x, double* y, double* scratch,
                     double magnitude) noexcept;
  void (*multiply32)(const ReadyProduct<float>& a, const double* x, double* y, float* scratch,
                     double magnitude) noexcept;
  Moments (*moments)(const double* f, std::size_t n) noexcept;
  double (*dot)(const double* a, const double* b, std::size_t n) noexcept;
  /// spread_i = (w_i (x_i - p_i))^2 share_i
  Misfit (*misfit)(const double* x, const double* p, const double* weights, const double* shares,
                   double* spread, std::size_t n) noexcept;
};

/// @param set  one that this machine runs
[[nodiscard]] const Kernels& kernels(InstructionSet set) noexcept;

}  // namespace tactile_net
