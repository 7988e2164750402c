/// @file
/// One choice of quantities and depths, of a line or a skin, and how two of them compare.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/skin/observability.hpp"

namespace tactile_net::lab {

struct SensorChoice {
  std::vector<Quantity> reads{};
  std::vector<double> depths{};  ///< [m]; of uneven skins of all taxels
  /// Tractions of each place: 1, the normal one alone; with drag 2 of a line, 3 of a skin.
  std::size_t unknowns = 1;
  /// What no reading shows of waves, whatever their length; of a line what it hides of the means.
  std::vector<HiddenWaves> hidden{};
  /// The array with its ends; absent: a skin of taxels anywhere. Of lines nothing is said of what
  /// dead taxels and ends do.
  std::optional<FiniteObservability> array{};
  std::optional<Identifiability> identifiability{};  ///< of lines: what stands behind `array`
  double wave_condition = 1.0;  ///< of skins, of `Survey::wave`; infinite below full rank
  /// Of waves from the mean, k = 0, to the shortest; those of a line run along y.
  std::vector<SkinResolution> resolutions{};
  /// [m]: the shortest wavelength of a ripple of the survey's traction from which on its parts
  /// stand out of the noise, a row for each `SkinRipple`: of waves along y, along z, and all.
  std::array<std::array<std::optional<double>, 3>, 3> wavelengths{};
  /// Width of the contact in the widest gap between taxels that no reading shows [m].
  std::optional<double> unseen{};

  /// The coarsest of `wavelengths`: of waves of every direction, and along each axis that has any.
  [[nodiscard]] std::optional<double> resolvable(SkinRipple ripple) const noexcept;
};

/// The parts of a ripple that a choice with so many unknowns has: p; with the drag along it; all.
[[nodiscard]] std::span<const SkinRipple> ripples_of(std::size_t unknowns) noexcept;

/// True if the mean of that traction shows in no kernel.
[[nodiscard]] bool hides_mean(const SensorChoice& choice, Traction component);

/// Combinations that no wave shows, the mean's included.
[[nodiscard]] std::size_t hidden_waves(const SensorChoice& choice) noexcept;

/// True if a combination of tractions shows in no reading, or one of a wave in no kernel.
[[nodiscard]] bool hides_anything(const SensorChoice& choice) noexcept;

/// The coarser `resolvable` of the drags [m]; absent: one has none, or drag is not solved for.
[[nodiscard]] std::optional<double> resolvable_drag(const SensorChoice& choice) noexcept;

/// The coarsest of the resolvable wavelengths [m]; infinite: one of its parts has none.
[[nodiscard]] double coarsest(const SensorChoice& choice) noexcept;

/// By what counts first. On a line: no hidden mean, the coarsest resolvable wavelength, no hidden
/// combination (a short one is below the noise anyway), the condition. On a skin: more unknowns,
/// fewer combinations hidden from all waves, the coarsest resolvable wavelength, a narrower contact
/// seen, the wave's condition.
[[nodiscard]] bool tells_more(const SensorChoice& a, const SensorChoice& b);

}  // namespace tactile_net::lab
