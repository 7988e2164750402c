/// @file
/// Before any reading: which tractions can these sensors tell apart?
///
/// The singular values of W K say how strongly each combination of tractions shows in the readings;
/// the combinations that do not show are described by their waves. `resolution.hpp` asks the same
/// wavelength by wavelength, with noise.
///
///     const Identifiability found = identifiability(make_problem(array, material, options));
///     found.rank                           // combinations that the readings tell apart
///     found.null_space.modes[0].wavelength  // of the longest wave that none of them shows
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"

namespace tactile_net {

/// What a mode does when the array is reflected about its centre.
enum class Parity { even, odd, neither };

/// A combination of tractions, described by the strongest of its wavelengths. Those that a vector
/// of `count` values is analysed into are 2 count pitch / m, m = 0 ... count: half waves too, since
/// the modes of an array with ends need not close on themselves.
struct TractionMode {
  double singular_value = 0.0;         ///< |W K v| for |v| = 1 [weighted reading per Pa]
  double normal_share = 1.0;           ///< share of its energy in the normal traction, 0 ... 1
  std::optional<double> wavelength{};  ///< its strongest wavelength [m]; absent: constant
  double wave_share = 1.0;             ///< share of its energy in `wavelength`, 0 ... 1
  bool alternating = false;            ///< `wavelength` is two pitches: Nyquist
  Parity parity = Parity::neither;     ///< parity of the traction that holds more of its energy
  std::optional<Traction> unknown{};   ///< holding at least 90 % of its energy; absent: both
};

/// A space of combinations of tractions. Singular vectors of (nearly) equal singular values are any
/// basis of their space; `modes` is the basis that waves give: each the purest wave that is left,
/// the longest first among equals.
struct ModeSpace {
  std::size_t dimension = 0;
  std::vector<TractionMode> modes{};  ///< the first few of the basis
  /// The longest wavelength that is half or more of a combination in the space [m]; infinite: a
  /// constant; 0: none is.
  double longest = 0.0;
  double shortest = 0.0;  ///< the shortest such wavelength [m]
};

/// The singular values of W K, and the tractions that they hide.
struct Identifiability {
  std::vector<double> singular_values{};  ///< one a traction, descending [weighted reading per Pa]
  double condition = 1.0;                 ///< largest over smallest; may be infinite
  double floor = 0.0;       ///< the larger of max(rows, columns) eps |W K| and the kernel's error
  std::size_t rank = 0;     ///< singular values above `floor`
  double noise_gain = 0.0;  ///< 1 / smallest [Pa per unit of weighted noise]; may be infinite
  ModeSpace null_space{};   ///< at or below `floor`: no reading shows it in double precision
  ModeSpace nearly_null{};  ///< up to sqrt(eps) of the largest: lost where P = K'K is formed
  TractionMode weakest{};   ///< the mode of the smallest singular value
};

/// O(rows x columns^2), and a small decomposition for every wavelength and every mode described.
[[nodiscard]] Identifiability identifiability(const LinearProblem& problem);

/// `identifiability(problem).null_space` with its first mode alone: what a warning needs. Costs one
/// singular value decomposition of W K, and nothing else where every combination shows.
[[nodiscard]] ModeSpace hidden_modes(const LinearProblem& problem);

/// `hidden_modes(problem)` where its family has been made: at no cost where the family shows that
/// nothing is hidden, as for most arrays.
[[nodiscard]] ModeSpace hidden_modes(const LinearProblem& problem, const TikhonovFamily& family);

/// How many combinations of tractions no kernel can show, by counting alone.
///
/// An array that is mirrored about its centre keeps two halves of the problem apart: normal of
/// even parity with tangential of odd parity, and the reverse. Each half has `count` unknowns (with
/// one unknown: the even or the odd normal tractions), and from each channel the even or the odd
/// half of its readings: the half that the parity of the kernels leads to. An odd count has one
/// more even vector than odd ones, so that a half may have fewer readings than unknowns: two
/// channels of stress_x, stress_y, strain_x and strain_y lose one, and so do two of shear_xy, or
/// one shear_xy with one unknown.
///
/// @param unknowns  1 or 2
[[nodiscard]] std::size_t lost_by_symmetry(const SensorArray& array, std::size_t unknowns);

}  // namespace tactile_net
