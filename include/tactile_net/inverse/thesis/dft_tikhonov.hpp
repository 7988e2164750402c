/// @file
/// The DFT approach for several readings and both tractions (target tactile_net::spectral). The
/// thesis' circular system, regularised, kept to be compared with: `FftTikhonov`
/// (inverse/fft_tikhonov.hpp) solves the system that has ends.
///
/// Solves the circular system, as dft.hpp does, but frequency by frequency in the sense of the same
/// functional as the matrix methods (linear_problem.hpp): with A the channels x unknowns matrix of
/// the weighted kernels' DFT at k,
///
///     |A F - G|^2 + alpha (1 + 4 l^2/D^2 sin^2(pi k / count)) |F|^2
///
/// by a singular value decomposition of each A: nothing is squared, and alpha = 0 gives the exact
/// inverse wherever there is one. For (stress_x, shear_xy) that is every frequency; a tangential
/// kernel of stress_x, stress_y or a strain is odd, so that its DFT vanishes at k = 0 and, for even
/// counts, at Nyquist: what these leave undetermined is a null mode, set to zero and listed.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// A combination of tractions that no reading shows.
struct DftNullMode {
  std::size_t frequency = 0;                  ///< 0 ... count / 2
  Traction unknown = Traction::tangential_y;  ///< the traction that has the larger part of it
  std::optional<double> wavelength{};         ///< count pitch / frequency [m]; absent: constant
  bool alternating = false;                   ///< `wavelength` is two pitches: Nyquist
};

class DftTikhonov {
 public:
  /// O(count log count).
  ///
  /// @param options  unknowns, smoothing length and weights; dead taxels cannot be left out
  /// @throw std::invalid_argument  as `make_problem`; there are dead taxels; the tractions do
  ///                               not lie at the taxels
  DftTikhonov(const SensorArray& array, const Material& material,
              const LineProblemOptions& options);
  ~DftTikhonov();
  DftTikhonov(DftTikhonov&&) noexcept;
  DftTikhonov& operator=(DftTikhonov&&) noexcept;

  /// The modes below 1e-13 of the largest singular value, lowest frequency first.
  [[nodiscard]] std::span<const DftNullMode> null_modes() const noexcept;

  /// Largest over smallest singular value of the regularised system, null modes left out: relative
  /// errors of the readings reach the tractions multiplied by up to this.
  [[nodiscard]] double condition(double alpha) const noexcept;

  /// The first-order bound of least squares for one frame of the circular system: how far rounding
  /// may have moved the tractions, over their 2-norm (see error_bound.hpp).
  [[nodiscard]] double forward_bound(std::span<const double> readings, double alpha,
                                     std::span<const double> tractions);

  /// True if the readings are cut off by the array's ends, where the circle closes: at either end
  /// the mean over a fortieth of the array, times `condition`, exceeds the peak, in some channel.
  /// What is cut off is folded in from the other end and amplified.
  [[nodiscard]] bool cut_off(std::span<const double> readings, double alpha) const noexcept;

  /// The frame in the Fourier basis: rules for alpha cost O(count) per alpha. Uses buffers of its
  /// own: one object per thread.
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings);

  /// One frame, O(count log count). `too_large` if any traction would not be finite, or the
  /// weighted readings or the transforms overflow on the way to it.
  ///
  /// @param readings   channels x count values
  /// @param alpha      >= 0
  /// @param tractions  f [Pa], unknowns x count values; untouched unless the status is `ok`
  FrameStatus solve(std::span<const double> readings, double alpha,
                    std::span<double> tractions) noexcept;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace tactile_net
