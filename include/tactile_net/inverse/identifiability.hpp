/// @file
/// Before any reading: which tractions can these sensors tell apart?
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/problem.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// A combination of tractions that no reading shows in double precision.
struct NullMode {
  double singular_value = 0.0;
  Traction unknown = Traction::normal;  ///< the larger part of it
  double share = 1.0;                   ///< of its energy in that unknown, 0.5 ... 1
  std::optional<double> wavelength{};   ///< the strongest [m]; absent: constant
  std::string description{};            ///< "tangential traction, constant (k = 0)"
};

/// The singular values of W K, and what they hide.
struct Identifiability {
  std::vector<double> singular_values{};  ///< descending [weighted reading per Pa]
  double condition = 1.0;                 ///< largest over smallest; may be infinite
  std::size_t rank = 0;     ///< values above max(rows, columns) eps and the kernel's error
  double noise_gain = 0.0;  ///< 1 / smallest: traction per unit of weighted noise; may be infinite
  std::vector<NullMode> null_modes{};  ///< columns - rank, the least visible first
};

/// O(rows x columns^2).
[[nodiscard]] Identifiability identifiability(const InverseProblem& problem);

/// How well a ripple of the traction is known from one frame of the whole array.
struct Resolution {
  double wavelength = std::numeric_limits<double>::infinity();  ///< [m]
  /// Standard deviation of the ripple's amplitude [Pa] per unit of `noise`; infinite: not seen.
  double normal = 0.0;
  double tangential = 0.0;  ///< infinite with one unknown
};

/// For the wavelengths count pitch / j, j = 0 ... count / 2, of an array long enough for its ends
/// not to matter. With the channels x unknowns matrix A of the weighted transforms at k, each of
/// the ripple's two real amplitudes has the variance
///
///     2 / count [(A* A)^-1]_uu        (1 / count for the mean and at Nyquist, which have one)
///
/// On the taxels' grid an odd kernel's response vanishes at k = 0 and at Nyquist: a tangential
/// traction is odd in stress_x, stress_y and the strains, a normal one in shear_xy.
///
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] std::vector<Resolution> resolutions(const SensorArray& array,
                                                  const Material& material,
                                                  const ProblemOptions& options);

/// The shortest wavelength such that it and every longer one, the mean aside, has at most `limit`
/// in `component`; absent: none.
[[nodiscard]] std::optional<double> resolvable_wavelength(const std::vector<Resolution>& all,
                                                          Traction component, double limit);

}  // namespace tactile_net
