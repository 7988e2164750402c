/// @file
/// Which resistors to buy how exactly: the cheapest list that meets an accuracy.
///
///     const std::vector<double> counts = relative_sensitivities(reduction);  // tolerance.hpp
///     const Allocation list = allocate(counts, {.target = 3e-3});
///     list.counts;   // how many of each class; list.price beside list.price_bound
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tactile_net {

/// Resistors that are sold within a relative error of what is printed on them.
struct PartClass {
  double tolerance = 0.01;  ///< > 0, < 1
  double price = 0.0;       ///< of one, in any currency, >= 0
  /// Standard deviation of their errors where it was measured, >= 0; absent: they are uniform
  /// within the tolerance.
  std::optional<double> spread{};
};

struct AllocationOptions {
  /// 95 of 100 builds err by at most this, relative to the answer's 2-norm, > 0.
  double target = 3e-3;
  /// The coarsest first, each finer than the one before and not cheaper. Typical prices on small
  /// reels.
  std::vector<PartClass> classes{{0.01, 0.002}, {0.001, 0.05}, {0.0005, 0.12}, {0.0001, 1.0}};
};

struct Allocation {
  std::vector<std::size_t> class_of{};  ///< of every resistor, as `Reduction::resistors()`
  std::vector<std::size_t> counts{};    ///< resistors of each class
  double price = 0.0;
  double price_bound = 0.0;  ///< no list that meets the target is cheaper (Lagrange's dual)
  double p95 = 0.0;          ///< that first order predicts
  bool met = false;  ///< false: the finest class everywhere does not do; then it is the list
};

/// 95 of 100 builds err by at most this often the root mean square: measured for this kind of
/// circuits, where many parts add up (docs/circuits.md).
inline constexpr double p95_over_rms = 1.55;

/// Errors are uniform within each class's tolerance and independent, so their squares add up. With
/// a Lagrange multiplier on the mean square error, each resistor's class is chosen by itself.
/// O(resistors log resistors).
///
/// @param sensitivities  as `relative_sensitivities`, one per resistor, >= 0 and finite
/// @throw std::invalid_argument  the target is not > 0, a sensitivity is not finite, there is no
///                               class, or classes are not in their order
[[nodiscard]] Allocation allocate(std::span<const double> sensitivities,
                                  const AllocationOptions& options);

}  // namespace tactile_net
