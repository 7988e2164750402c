/// @file
/// [W K; sqrt(alpha) L] of a large skin as products, never as a matrix. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "skin/large/lattice_products.hpp"
#include "tactile_net/skin/large/system.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// Rows: the readings, then of every traction its size, its slope along y and along z.
struct LargeSkinSystem {
  /// @throw std::invalid_argument  as `make_problem`; the taxels do not lie on the cells' lattice,
  ///                               or offsets are unknown
  LargeSkinSystem(const SkinArray& array, const Material& material,
                  const SkinProblemOptions& options);

  [[nodiscard]] std::size_t tractions() const noexcept {
    return problem.components * problem.grid.count();
  }
  [[nodiscard]] std::size_t readings() const noexcept { return problem.weights.size(); }
  [[nodiscard]] std::size_t rows() const noexcept { return readings() + 3 * tractions(); }

  /// W K x. @pre  sizes fit, here and below
  void weighted_readings(std::span<const double> x, std::span<double> y) noexcept;
  /// K' W y.
  void weighted_sums(std::span<const double> y, std::span<double> x) noexcept;

  /// [W K; sqrt(alpha) L] x.
  void apply(double alpha, std::span<const double> x, std::span<double> y) noexcept;
  /// Its transposed times y.
  void apply_transposed(double alpha, std::span<const double> y, std::span<double> x) noexcept;

  /// sqrt(alpha A/P) w of a component.
  [[nodiscard]] double size_of(double alpha, std::size_t component) const noexcept;

  SkinArray skin;
  LinearProblem problem;  ///< without its kernel
  std::vector<LatticeKernel> kernels;
  LatticeProducts products;

 private:
  void walk_stabiliser(double alpha, const auto& visit) const noexcept;

  std::vector<double> scratch_;  // W y
};

/// Of each taxel.
[[nodiscard]] std::vector<bool> dead_taxels(const LinearProblem& problem);

/// @throw std::invalid_argument  a block of P is not positive definite: alpha is too small
void require_definite(bool is_positive_definite);

}  // namespace tactile_net
