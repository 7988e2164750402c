/// @file
/// What the sensors of a line or a skin can tell, beside what others in their place could.
///
///     const lab::Survey survey = lab::identify(read_scene("pad.toml"));
///     survey.own.array->hidden                        // combinations that no reading shows
///     survey.own.hidden                               // of which waves none shows what
///     survey.own.resolvable(SkinRipple::drag_along)   // from which wavelength on it is told
///     survey.advice.best                              // which alternative tells most
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/hidden_reason.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/sensor_choice.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::lab {

struct SurveyOptions {
  /// A ripple's amplitude [Pa]. Absent: the contacts' peak; see `needs_traction`.
  std::optional<double> traction{};
  /// Noise of every channel over the largest reading that such a ripple of normal traction causes.
  /// Absent: the scene's rms; for quantities it has none of, the same share, or 1 %.
  std::optional<double> relative_noise{};
};

/// @throw std::invalid_argument  an option is not > 0 and finite
void check(const SurveyOptions& options);

/// The noise that every channel is taken to have.
struct AssumedNoise {
  enum class Kind {
    stated,  ///< the scene's rms; for quantities without one, the share
    share,   ///< the share for all of them
  };
  Kind kind = Kind::share;
  double share = 0.01;  ///< of the largest reading that a ripple of normal traction causes
};

/// What to read instead: indices of `Survey::alternatives`, each absent where it would change
/// little or is named before. With none of them nothing compared tells more.
struct Advice {
  /// At the same depths; on a line as many quantities, one of them kept where there are several, on
  /// a skin no more of them.
  std::optional<std::size_t> exchange{};
  std::optional<std::size_t> pair_here{};  ///< of a line: for both tractions at the first depth
  std::optional<std::size_t> best{};       ///< of all; of a line of those for both tractions
};

/// How strongly one quantity at one depth answers to the survey's wave.
struct WaveShare {
  Quantity quantity = Quantity::stress_x;
  double depth = 0.0;  ///< [m]
  /// |reading| over its noise, of a ripple of the survey's traction in each `SkinRipple`; 0: none.
  std::array<double, 3> signal{};
};

struct Survey {
  SensorChoice own{};
  /// Other quantities and depths in the scene's place, then the best of them elsewhere.
  std::vector<SensorChoice> alternatives{};
  double traction = 1.0;  ///< amplitude of the ripple to be told [Pa]
  AssumedNoise noise{};
  double wave = 1.0;                ///< length of the wave of which shares are [m]
  std::vector<WaveShare> shares{};  ///< of the scene's sensors
  /// Of the taxels whose singular values are judged, of a line of the alternatives alone. A line's
  /// are rows of one column.
  std::size_t rows = 0;
  std::size_t columns = 1;
  bool is_whole = true;                 ///< these are all that the scene has
  std::vector<HiddenReason> reasons{};  ///< of what a line's own sensors hide
  Advice advice{};

  [[nodiscard]] bool is_skin() const noexcept { return !own.identifiability; }
};

/// Whether nothing says how strong a ripple is to be told: the scene states its noise and has no
/// contact to compare it with. Without a stated noise the amplitude cancels.
[[nodiscard]] bool needs_traction(const Scene& scene, const SurveyOptions& options);
[[nodiscard]] bool needs_traction(const SkinScene& scene, const SurveyOptions& options);

/// The amplitude of the ripple whose readings would be as large as recorded ones [Pa].
///
/// @param largest  |reading| of each channel, in the order of `channels`
/// @throw std::invalid_argument  not one value per channel, or none is > 0 and finite
[[nodiscard]] double traction_behind(const Scene& scene, std::span<const double> largest);
[[nodiscard]] double traction_behind(const SkinScene& scene, std::span<const double> largest);

/// Decomposes some matrices for the scene and about thirty smaller ones for the alternatives.
///
/// @throw std::invalid_argument  an option is not > 0 and finite; `needs_traction`; the scene's
///                               sensor, material or noise are out of their ranges
[[nodiscard]] Survey identify(const Scene& scene, const SurveyOptions& options = {},
                              Observer& observer = silent);
[[nodiscard]] Survey identify(const SkinScene& scene, const SurveyOptions& options = {},
                              Observer& observer = silent);

}  // namespace tactile_net::lab
