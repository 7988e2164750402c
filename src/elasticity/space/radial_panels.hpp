/// @file
/// A field's functions of the distance, interpolated. Private.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "elasticity/space/layer_table.hpp"

namespace tactile_net {

/// The functions f / r^j of `LayerTable` by Chebyshev's polynomials, a sum of `count` of them in
/// each panel of r.
///
/// @tparam count  a multiple of 4
template <std::size_t count>
class RadialPanels {
  static_assert(count % 4 == 0);

 public:
  /// All functions are 0 until values are added.
  ///
  /// @param edges  the panels' ends in order, from 0 on
  explicit RadialPanels(std::vector<double> edges)
      : edges_(std::move(edges)), coefficients_(panels() * tables * count) {}

  [[nodiscard]] std::size_t panels() const noexcept { return edges_.size() - 1; }
  [[nodiscard]] double end() const noexcept { return edges_.back(); }

  /// The distance of node i, of `count`, of a panel.
  [[nodiscard]] double node(std::size_t panel, std::size_t i) const noexcept {
    return node(edges_[panel], edges_[panel + 1], i);
  }
  [[nodiscard]] static double node(double from, double to, std::size_t i) noexcept {
    return from + 0.5 * (to - from) * (1.0 + std::cos(angle(i)));
  }

  /// Adds to the functions what has these values of f / r^j at a panel's node, and 0 at the others.
  void add(std::size_t panel, std::size_t i, const LayerFunctionValues& values) noexcept {
    double* const coefficients = of_panel(panel);
    for (std::size_t t = 0; t < tables; ++t)
      for (std::size_t n = 0; n < count; ++n)
        coefficients[t * count + n] += (n == 0 ? 1.0 : 2.0) / static_cast<double>(count) *
                                       values[t] * std::cos(static_cast<double>(n) * angle(i));
  }

  /// Gives one function one value in a panel.
  void fill(std::size_t panel, LayerTable table, double coefficient) noexcept {
    std::fill_n(of_panel(panel) + static_cast<std::size_t>(table) * count, count, coefficient);
  }

  /// Chebyshev's polynomials at one distance, for any of the tables.
  class At {
   public:
    /// f / r^j.
    [[nodiscard]] double operator()(LayerTable table) const noexcept {
      const double* const c = coefficients_ + static_cast<std::size_t>(table) * count;
      double sums[4] = {};
      for (std::size_t n = 0; n < count; n += 4)
        for (std::size_t lane = 0; lane < 4; ++lane)
          sums[lane] += c[n + lane] * polynomials_[n + lane];
      return (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }

   private:
    friend class RadialPanels;
    At() = default;
    const double* coefficients_ = nullptr;
    std::array<double, count> polynomials_{};
  };

  /// @param r  in [0, end())
  [[nodiscard]] At at(double r) const noexcept {
    const auto end = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, r);
    const auto panel = static_cast<std::size_t>(end - edges_.begin()) - 1;
    const double from = edges_[panel];
    const double s = 2.0 * (r - from) / (edges_[panel + 1] - from) - 1.0;
    At at;
    at.coefficients_ = coefficients_.data() + panel * tables * count;
    at.polynomials_[0] = 1.0;
    at.polynomials_[1] = s;
    // From those near n / 2, so that no long chain of sums waits for the one before.
    for (std::size_t n = 2; n < count; ++n) {
      const std::size_t m = std::bit_floor(n - 1);
      at.polynomials_[n] =
          2.0 * at.polynomials_[m] * at.polynomials_[n - m] - at.polynomials_[2 * m - n];
    }
    return at;
  }

 private:
  static constexpr std::size_t tables = layer_table_orders.size();

  static double angle(std::size_t i) noexcept {
    return std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  }
  double* of_panel(std::size_t panel) noexcept {
    return coefficients_.data() + panel * tables * count;
  }

  std::vector<double> edges_;
  std::vector<double> coefficients_;  // panel by panel, table by table
};

}  // namespace tactile_net
