/// @file
/// Private. Tikhonov's method on a skin by conjugate gradients with the matrix itself: a step is
/// two products with W K. For skins whose cells are no lattice of their taxels, and to see what an
/// answer costs that is not waited for; `LargeSkinTikhonov` (large/tikhonov.hpp) takes products by
/// FFT.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net::study {

/// In coordinates in which the stabiliser is |x|^2, by CGLS: P is never formed. The k-th answer is
/// the best of its Krylov space, so that the error in P's norm falls with every step; as many steps
/// as there are different singular values above sqrt(alpha) are enough.
class SkinMatrixGradients {
 public:
  /// O(readings x tractions).
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  SkinMatrixGradients(const LinearProblem& problem, double alpha);
  ~SkinMatrixGradients();
  SkinMatrixGradients(SkinMatrixGradients&&) noexcept;
  SkinMatrixGradients& operator=(SkinMatrixGradients&&) noexcept;

  /// One frame, from 0. `too_large` if a weighted reading or a traction would not be finite.
  ///
  /// @param tractions  f [Pa]; untouched unless the status is `ok`
  /// @param steps      >= 1; it ends sooner where nothing is left to gain
  /// @throw std::invalid_argument  readings or tractions have the wrong size
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions,
                    std::size_t steps) const;

 private:
  struct System;
  std::unique_ptr<const System> system_;
};

}  // namespace tactile_net::study
