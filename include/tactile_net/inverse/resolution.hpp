/// @file
/// How well each wavelength of the tractions is known from one frame with noise.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"

namespace tactile_net {

/// How well a ripple of the traction is known from one frame of the whole array.
struct Resolution {
  double wavelength = std::numeric_limits<double>::infinity();  ///< [m]
  /// Standard deviation of the ripple's amplitude [Pa] per unit of weighted noise; infinite: not
  /// seen.
  double normal = 0.0;
  double tangential = 0.0;  ///< infinite with one unknown
};

/// Resolutions for the wavelengths count pitch / j, j = 0 ... count / 2, of an array long enough
/// for its ends not to matter; dead taxels are not considered. White noise of unit variance in
/// `count` readings has the variance `count` in each of their Fourier coefficients; least squares
/// with the matrix A of the kernels' exact transforms, channels x unknowns, turns that into count
/// [(A* A)^-1]_uu, and a cosine's amplitude is 2 / count times the real part of its coefficient,
/// which has half of the variance:
///
///     variance of the amplitude = 2 / count [(A* A)^-1]_uu
///
/// with 1 / count for the mean and at Nyquist, whose coefficient is real.
///
/// On the taxels' grid an odd kernel's response vanishes at k = 0 and at Nyquist: a tangential
/// traction is odd in stress_x, stress_y and the strains, a normal one in shear_xy. Elsewhere the
/// sampled kernels' response is that of A but for aliases, exp(-2 pi depth / pitch + k depth).
///
/// The taxels of an irregular array are taken to be equally spaced, each at its depth.
///
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] std::vector<Resolution> resolutions(const SensorArray& array,
                                                  const Material& material,
                                                  const LineProblemOptions& options);

/// The shortest wavelength such that it and every longer one, the mean aside, has at most `limit`
/// [Pa per unit of weighted noise] in `component`; absent: none.
[[nodiscard]] std::optional<double> resolvable_wavelength(std::span<const Resolution> all,
                                                          Traction component, double limit);

}  // namespace tactile_net
