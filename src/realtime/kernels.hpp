/// @file
/// The loops of a frame, each compiled once for every instruction set. Private.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "realtime/aligned.hpp"
#include "realtime/folding.hpp"
#include "realtime/ready_product.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// A limit that refuses nothing, for input that has been compared with one before.
inline constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// A number of which integers order as doubles do; of NaN beyond those of the infinities.
[[nodiscard]] constexpr std::int64_t ordered(double value) noexcept {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits ^ ((bits >> 63) & std::numeric_limits<std::int64_t>::max());
}

/// The ends of the range of each reading, as `ordered` numbers.
struct OrderedRanges {
  Aligned<std::int64_t> lowest, highest;
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
  /// @return false, and y is untouched: an |x| is NaN or beyond `limit`, as `largest` has it; that
  ///         is asked before the first sum, so that none of infinities or of too large numbers is
  ///         taken: it would raise a floating-point exception
  bool (*multiply64)(const ReadyProduct<double>& a, Difference x, double* y, double* scratch,
                     double magnitude, std::span<Moments> moments, std::uint64_t limit) noexcept;
  bool (*multiply32)(const ReadyProduct<float>& a, Difference x, double* y, float* scratch,
                     double magnitude, std::span<Moments> moments, std::uint64_t limit) noexcept;
  /// x times a factor as the factors of A take it, and y of what they give, times another: what a
  /// product does before and after them, for who applies these to many frames at once.
  void (*part64)(const ReadyProduct<double>& a, Difference x, double factor,
                 double* input) noexcept;
  void (*part32)(const ReadyProduct<float>& a, Difference x, double factor, float* input) noexcept;
  void (*join64)(const ReadyProduct<double>& a, double* output, double factor, double* y,
                 std::span<Moments> moments) noexcept;
  void (*join32)(const ReadyProduct<float>& a, float* output, double factor, double* y,
                 std::span<Moments> moments) noexcept;
  double (*dot)(const double* a, const double* b, std::size_t n) noexcept;
  /// Stretches of values above a share in (0, 1) of the largest one; 0: none is above 0.
  std::size_t (*stretches)(const double* p, std::size_t n, double share) noexcept;
  /// spread_i = (w_i (x_i - p_i))^2 share_i
  Misfit (*misfit)(const double* x, const double* p, const double* weights, const double* shares,
                   double* spread, std::size_t n) noexcept;
  /// Whether a reading with a weight is not between its ends, or NaN; no exception is raised.
  bool (*outside)(const double* g, const double* weights, const OrderedRanges& ranges,
                  std::size_t n) noexcept;
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
