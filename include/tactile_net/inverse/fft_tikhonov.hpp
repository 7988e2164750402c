/// @file
/// P f = b by FFT, boundaries included (target tactile_net::spectral).
///
/// Filtering by FFT, zero-padded or not, solves a circular system, whose answer is some 20 % off
/// where a contact touches the array's end (dft_tikhonov.hpp solves that one, and says so). Here
/// the FFT only multiplies by the true Toeplitz blocks; the minimiser of linear_problem.hpp is
/// found by conjugate gradients on the stacked matrix [W K; sqrt(alpha) L] (CGLS: P is never
/// formed), with the circular inverse, frequency by frequency, as preconditioner. About ten steps,
/// each O(count log count): for arrays for which a dense factorisation is slow.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// How the iteration for one frame ended.
struct Convergence {
  std::size_t steps = 0;
  /// Estimate of |error|_2 / |f|_2 of the iterate four steps back: the P-norm that the last four
  /// steps gained (Hestenes and Stiefel 1952, section 6), turned into the 2-norm by P >= alpha. The
  /// answer returned is better.
  double estimate = 0.0;
  double bound = 0.0;     ///< proven bound of |error|_2 / |f|_2: |gradient| / (alpha |f|)
  bool converged = true;  ///< `estimate` or `bound` reached the tolerance
};

class FftTikhonov {
 public:
  /// Plans and transforms the kernels. O(count log count), for a layer with its integrals.
  ///
  /// @param alpha  > 0
  /// @throw std::invalid_argument  as `make_problem`; alpha is not > 0 and finite
  FftTikhonov(const SensorArray& array, const Material& material, const LineProblemOptions& options,
              double alpha);
  ~FftTikhonov();
  FftTikhonov(FftTikhonov&&) noexcept;
  FftTikhonov& operator=(FftTikhonov&&) noexcept;

  /// Takes another alpha, > 0, for the frames to come: kernels and transforms stay.
  /// O(count), allocates nothing.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  void use_alpha(double alpha);

  /// One frame. Uses buffers of its own: one object per thread. Allocates nothing.
  ///
  /// `too_large` if any weighted reading or traction would not be finite.
  ///
  /// @param readings    channels x count values
  /// @param tractions   f [Pa], unknowns x count values; untouched unless the status is `ok`
  /// @param tolerance   wanted |error|_2 / |f|_2 against the exact minimiser, > 0
  /// @param step_limit  after which the best so far is returned, with `converged` false
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions,
                    double tolerance = 1e-10, std::size_t step_limit = 200) noexcept;

  /// P^-1 times `right` by conjugate gradients, until the gradient is 1e-10 of it or after 1000
  /// steps. Allocates. @pre  right has one value per traction
  [[nodiscard]] std::vector<double> solve_normal(std::span<const double> right);

  /// [W K; sqrt(alpha) L] times tractions: their weighted readings, then the smoothness terms.
  /// Allocates. @pre  there is one value per traction
  [[nodiscard]] std::vector<double> stacked_product(std::span<const double> tractions);

  /// |W (K f - g)|_2. Allocates. @throw std::invalid_argument  sizes are not `solve`'s
  [[nodiscard]] double residual(std::span<const double> readings,
                                std::span<const double> tractions);

  /// How the iteration for the last frame ended.
  [[nodiscard]] const Convergence& convergence() const noexcept;

  [[nodiscard]] std::size_t readings() const noexcept;
  [[nodiscard]] std::size_t tractions() const noexcept;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace tactile_net
