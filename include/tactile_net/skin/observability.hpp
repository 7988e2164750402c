/// @file
/// Before any reading: which tractions can a skin tell apart?
///
/// First wave by wave, by the kernels' exact transforms: three tractions p, q_L along the wave and
/// q_T across it, whose field is the curl of q. Some readings never see a combination, at any
/// number of depths. Then the finite array: what only its ends decide is known badly, however well
/// it looks.
///
///     const SkinObservability found = observability(skin, silicone, options);
///     found.hidden[0].curl                 // the curl of q is seen by no depth of stress_x
///     found.finite->boundary_only          // combinations that only the ends of the array decide
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// How well readings tell the tractions of one wave apart.
struct WaveObservability {
  std::vector<double> singular_values{};  ///< one a component, descending [weighted reading per Pa]
  std::size_t rank = 0;                   ///< singular values above 1e-10 of the largest
  double condition = 1.0;                 ///< largest over smallest; infinite below full rank
};
/// Observability of the tractions of one wave.
/// @param wavenumber_y, wavenumber_z  k [1/m]
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] WaveObservability wave_observability(const SkinArray& skin, const Material& material,
                                                   const SkinProblemOptions& options,
                                                   double wavenumber_y, double wavenumber_z);

/// The waves that `HiddenWaves` is said of.
enum class WaveDirection { any, along_y, along_z, diagonal, mean };

inline constexpr Enumerator<WaveDirection> wave_directions[] = {
    {WaveDirection::any, "any", "Every wave."},
    {WaveDirection::along_y, "along_y", "Waves that run along y."},
    {WaveDirection::along_z, "along_z", "Waves that run along z."},
    {WaveDirection::diagonal, "diagonal", "Waves that run along the diagonals."},
    {WaveDirection::mean, "mean",
     "What is uniform: drag_along is then the drag along y, drag_across that along z."}};
template <>
struct Enumerators<WaveDirection> {
  static constexpr const auto& all = wave_directions;
};

/// "any", "along_y", "along_z", "diagonal", "mean".
[[nodiscard]] std::string_view name(WaveDirection direction) noexcept;

/// The tractions that no reading shows of waves in a direction, whatever their length. For the
/// mean, `divergence` stands for q_y and `curl` for q_z.
struct HiddenWaves {
  WaveDirection direction = WaveDirection::any;
  bool normal = false;      ///< p
  bool divergence = false;  ///< q_L, along the wave
  bool curl = false;        ///< q_T, across it
  std::size_t mixed = 0;    ///< number of hidden combinations of several of them, besides
  [[nodiscard]] std::size_t count() const noexcept {
    return static_cast<std::size_t>(normal) + static_cast<std::size_t>(divergence) +
           static_cast<std::size_t>(curl) + mixed;
  }
};

/// How well the readings of a finite regular skin tell tractions apart, on cells at the taxels
/// without a margin: as many unknowns as places, times components.
struct FiniteObservability {
  std::size_t tractions = 0;  ///< number of unknowns
  /// Number of singular values of W K up to the larger of max(rows, columns) eps |W K| and the
  /// kernel's error.
  std::size_t hidden = 0;
  double condition = 1.0;   ///< largest over smallest of the other singular values
  double noise_gain = 0.0;  ///< 1 / smallest [Pa per unit of weighted noise]; infinite if any
                            ///< is hidden
  std::size_t dead = 0;     ///< hidden combinations that the dead taxels would show
  /// Number of combinations that the lattice without ends would hide, summed over its waves.
  std::size_t hidden_waves = 0;
  /// Number of these that the finite array shows: by its ends alone.
  std::size_t boundary_only = 0;
};

struct SkinObservability {
  std::vector<HiddenWaves> hidden{};  ///< any direction first; others where they hide more
  std::optional<FiniteObservability> finite{};  ///< absent: an irregular skin
};

/// What the readings of a skin can tell of tractions. Costs some 40 small decompositions; for a
/// regular skin one more for each wave, and one of W K.
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] SkinObservability observability(const SkinArray& skin, const Material& material,
                                              const SkinProblemOptions& options);

/// What a ripple of tractions is made of: p, the drag along the wave, whose field has no curl, and
/// the drag across it, whose field is all curl. For the mean: the drags along y and along z.
enum class SkinRipple { pressure, drag_along, drag_across };

inline constexpr std::array skin_ripples = {SkinRipple::pressure, SkinRipple::drag_along,
                                            SkinRipple::drag_across};

/// "pressure", "drag_along", "drag_across".
[[nodiscard]] std::string_view name(SkinRipple ripple) noexcept;

/// How well a ripple of each traction is known from one frame of the whole array.
struct SkinResolution {
  double wavenumber_y = 0.0;  ///< [1/m]
  double wavenumber_z = 0.0;
  /// Standard deviation of the ripples' amplitudes p, q_y, q_z [Pa] per unit of weighted noise;
  /// infinite: not seen.
  std::array<double, 3> deviations{};
  std::array<double, 3> of_wave{};  ///< deviations [Pa] of each `SkinRipple`

  /// Wavelength of the ripple [m]; infinite: the mean.
  [[nodiscard]] double wavelength() const noexcept;
};

/// Resolutions for the waves of a lattice without ends of as many rows and columns, half of them
/// (the other half is the same by symmetry), the mean first, then row after row. As in
/// `resolutions` of inverse/resolution.hpp the ends and dead taxels are not considered.
///
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] std::vector<SkinResolution> skin_resolutions(const SkinArray& skin,
                                                           const Material& material,
                                                           const SkinProblemOptions& options);

/// The shortest wavelength such that it and every longer one, the mean aside, has at most `limit`
/// [Pa per unit of weighted noise] in `component`; absent: none.
[[nodiscard]] std::optional<double> resolvable_wavelength(std::span<const SkinResolution> all,
                                                          Traction component, double limit);

/// The shortest wavelength such that it and every longer one that runs in `direction`, the mean
/// aside, has at most `limit` [Pa per unit of weighted noise] in `ripple`; absent: none. `any`:
/// waves of every direction. Along an axis with one taxel there is no wave.
/// @pre  the direction is not `mean`
[[nodiscard]] std::optional<double> resolvable_wavelength(std::span<const SkinResolution> all,
                                                          SkinRipple ripple,
                                                          WaveDirection direction, double limit);

}  // namespace tactile_net
