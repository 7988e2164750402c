/// @file
/// What a scene's sensors can tell, beside what others in their place could.
///
///     const lab::Survey survey = lab::identify(read_scene("pad.toml"));
///     survey.own.identifiability.null_space.dimension  // combinations that no reading shows
///     survey.reasons                                   // why
///     survey.advice.exchange                           // which alternative tells them
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/hidden_reason.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/sensor_choice.hpp"
#include "tactile_net/scene/scene.hpp"

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
  /// As many quantities at the same depths, one of them kept where there are several.
  std::optional<std::size_t> exchange{};
  std::optional<std::size_t> pair_here{};  ///< of those for both tractions at the first depth
  std::optional<std::size_t> best{};       ///< of all for both tractions
};

struct Survey {
  SensorChoice own{};
  /// Singles, pairs and singles at two depths in the scene's place, then the best pairs elsewhere.
  std::vector<SensorChoice> alternatives{};
  double traction = 1.0;  ///< amplitude of the ripple to be told [Pa]
  AssumedNoise noise{};
  std::size_t taxels = 0;  ///< of which the alternatives' singular values are; <= the scene's count
  std::vector<HiddenReason> reasons{};  ///< of what the scene's own sensors hide
  Advice advice{};
};

/// Whether nothing says how strong a ripple is to be told: the scene states its noise and has no
/// contact to compare it with. Without a stated noise the amplitude cancels.
[[nodiscard]] bool needs_traction(const Scene& scene, const SurveyOptions& options);

/// The amplitude of the ripple whose readings would be as large as recorded ones [Pa].
///
/// @param largest  |reading| of each channel, in the order of `channels`
/// @throw std::invalid_argument  not one value per channel, or none is > 0 and finite
[[nodiscard]] double traction_behind(const Scene& scene, std::span<const double> largest);

/// Decomposes one matrix for the scene and about thirty smaller ones for the alternatives.
///
/// @throw std::invalid_argument  an option is not > 0 and finite; `needs_traction`; the scene's
///                               sensor, material or noise are out of their ranges
[[nodiscard]] Survey identify(const Scene& scene, const SurveyOptions& options = {},
                              Observer& observer = silent);

}  // namespace tactile_net::lab
