/// @file
/// What the rules for alpha ask of a large skin (target tactile_net::spectral).
///
/// Rules ask for sums F = u' phi(A A') u, A = W K L^-1, with u the frame, and for traces of such
/// functions. A run of Golub and Kahan's bidiagonalisation from u gives nodes and weights that
/// stand for the spectrum of A A' as u sees it, for every alpha at once (Gauss quadrature; Golub
/// and Meurant, Matrices, Moments and Quadrature, 2010). Traces are means over probes of random
/// signs (Hutchinson 1990), always the same: equal input, equal bytes.
///
/// A run ends where the frame's fit stands still to 1e-3 for eight decades of alpha; a trace has
/// the deviation of its probes. The tests hold alpha to 15 % of that of all singular values, and
/// the tractions to 3 %.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/skin/cone.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net {

class LargeSkinFamily {
 public:
  /// Runs the probes: for each up to 300 products with K and its transposed.
  ///
  /// @param probes  >= 1
  explicit LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system, std::size_t probes = 4);
  explicit LargeSkinFamily(const LargeSkinTikhonov& solver, std::size_t probes = 4);
  /// Of the tractions that a face of the cones leaves free, as `SkinFamily`'s.
  /// @throw std::invalid_argument  the face leaves nothing free, or is of another problem
  LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system, const ConeFace& face,
                  std::size_t probes = 4);
  /// With the probes of another's, of the same skin without these dead taxels: no product. Their
  /// share of the taxels is about what the traces may be off by; of some hundredths that is less
  /// than the probes' own deviation.
  LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system, const LargeSkinFamily& like);
  ~LargeSkinFamily();
  LargeSkinFamily(LargeSkinFamily&&) noexcept;
  LargeSkinFamily& operator=(LargeSkinFamily&&) noexcept;

  /// The frame for the rules for alpha, with `shares` and `powers`: nodes of the probes, then of
  /// the frame. One run.
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const;

  /// tr H, by the probes.
  [[nodiscard]] double degrees_of_freedom(double alpha) const noexcept;
  /// How far the probes' values of tr H spread, as the standard deviation of their mean; 0 of one.
  [[nodiscard]] double degrees_deviation(double alpha) const noexcept;

  /// As `SkinFamily`'s: at most this, with the largest node for the largest singular value.
  [[nodiscard]] double condition(double alpha) const noexcept;
  [[nodiscard]] double stacked_condition(double alpha) const noexcept;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
