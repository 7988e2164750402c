/// @file
/// What a skin's sensors can tell, beside what others in their place could: as lab/identify.hpp,
/// with three tractions.
///
///     const lab::SkinSurvey survey = lab::identify(skin_scene);
///     survey.own.told.hidden                           // of which waves no reading shows what
///     survey.own.resolvable(SkinRipple::drag_across)   // from which wavelength on it is told
///     survey.best                                      // which alternative tells most
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/identify.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/skin/observability.hpp"

namespace tactile_net::lab {

/// The parts of a ripple that a problem of so many components has: p, or all three.
[[nodiscard]] std::span<const SkinRipple> ripples_of(std::size_t components) noexcept;

/// One choice of quantities and depths.
struct SkinSensorChoice {
  std::vector<Quantity> reads{};
  std::vector<double> depths{};  ///< [m]; of uneven skins of all taxels
  std::size_t components = 3;    ///< 1: p alone
  SkinObservability told{};
  double wave_condition = 1.0;  ///< of `SkinSurvey::wave`; infinite below full rank
  std::vector<SkinResolution> resolutions{};
  /// [m]: the shortest wavelength of a ripple of the survey's traction from which on its parts
  /// stand out of the noise, a row for each `SkinRipple`: of waves along y, along z, and all.
  std::array<std::array<std::optional<double>, 3>, 3> wavelengths{};
  std::optional<double> unseen{};  ///< width of a contact [m], `skin_unseen_width`

  /// The coarsest of those: of waves of every direction, and along each axis that has any.
  [[nodiscard]] std::optional<double> resolvable(SkinRipple ripple) const noexcept;
};

/// Combinations that no wave shows, the mean's included.
[[nodiscard]] std::size_t hidden_waves(const SkinSensorChoice& choice) noexcept;

/// The coarsest resolvable wavelength of its parts [m]; infinite: one of them has none.
[[nodiscard]] double coarsest(const SkinSensorChoice& choice) noexcept;

/// By what counts first: more components, fewer combinations hidden from all waves, the coarsest
/// resolvable wavelength, a narrower contact seen, the wave's condition.
[[nodiscard]] bool tells_more(const SkinSensorChoice& a, const SkinSensorChoice& b);

/// How strongly one quantity at one depth answers to the survey's wave.
struct WaveShare {
  Quantity quantity = Quantity::stress_x;
  double depth = 0.0;  ///< [m]
  /// |reading| over its noise, of a ripple of the survey's traction in each `SkinRipple`; 0: none.
  std::array<double, 3> signal{};
};

struct SkinSurvey {
  SkinSensorChoice own{};
  /// The scene's quantities and depths apart, other sets in their place, and the best elsewhere.
  std::vector<SkinSensorChoice> alternatives{};
  double traction = 1.0;  ///< amplitude of the ripple to be told [Pa]
  AssumedNoise noise{};
  double wave = 1.0;                ///< length of the oblique wave of which shares are [m]
  std::vector<WaveShare> shares{};  ///< of the scene's sensors
  /// Of the lattice whose singular values are judged; fewer than the scene's where those are many.
  std::size_t rows = 0;
  std::size_t columns = 0;
  /// Indices of `alternatives`, absent where they would change little or are the same: of those at
  /// the scene's depths with no more quantities, and of all.
  std::optional<std::size_t> exchange{};
  std::optional<std::size_t> best{};
};

/// As of a line's scene, in lab/identify.hpp.
[[nodiscard]] bool needs_traction(const SkinScene& scene, const SurveyOptions& options);

/// As of a line's scene. @param largest  |reading| of each channel, in the order of `channels`
/// @throw std::invalid_argument  not one value per channel, or none is > 0 and finite
[[nodiscard]] double traction_behind(const SkinScene& scene, std::span<const double> largest);

/// Decomposes some small matrices for the scene and each of about thirty alternatives.
///
/// @throw std::invalid_argument  an option is not > 0 and finite; `needs_traction`; the scene's
///                               sensor, material or noise are out of their ranges
[[nodiscard]] SkinSurvey identify(const SkinScene& scene, const SurveyOptions& options = {},
                                  Observer& observer = silent);

}  // namespace tactile_net::lab
