/// @file
/// What a scene's sensors can tell, beside what others in their place could.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/resolution.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// One choice of quantities and depths.
struct SensorChoice {
  std::vector<Quantity> reads{};
  std::vector<double> depths{};
  std::size_t unknowns = 1;
  Identifiability identifiability{};
  std::vector<Resolution> resolutions{};
  std::optional<double> normal{};      ///< resolvable wavelength [m]
  std::optional<double> tangential{};  ///< the same; absent with one unknown too
};

struct SurveyOptions {
  std::optional<double>
      traction{};  ///< a ripple's amplitude [Pa]; absent: the contacts' peak, or 1
  /// Noise of every channel over the largest reading that such a ripple of normal traction causes.
  /// Absent: the scene's rms; for quantities it has none of, the same share, or 1 %.
  std::optional<double> relative_noise{};
};

struct Survey {
  SensorChoice own{};
  /// Singles, pairs and singles at two depths in the scene's place, then the best pairs elsewhere.
  std::vector<SensorChoice> alternatives{};
  double traction = 1.0;   ///< [Pa]
  std::string noise{};     ///< which noise was assumed, in words
  std::size_t taxels = 0;  ///< of which the alternatives' singular values are; <= the scene's count
};

[[nodiscard]] Survey identify(const Scene& scene, const SurveyOptions& options,
                              Observer& observer = silent);

/// True if the mean of that traction shows in no kernel: `resolutions` at k = 0.
[[nodiscard]] bool hides_mean(const SensorChoice& choice, Traction component);

/// The coarser of the resolvable wavelengths [m]; infinite: there is none.
[[nodiscard]] double coarsest(const SensorChoice& choice);

/// By what counts first: no hidden mean, the coarsest resolvable wavelength, no hidden combination
/// (a short one is below the noise anyway), the condition.
[[nodiscard]] bool tells_more(const SensorChoice& a, const SensorChoice& b);

/// "stress_x, shear_xy at 1.5"
[[nodiscard]] std::string in_words(const SensorChoice& choice);

/// "-", "tangential, alternating", "81 modes, wavelengths 1 to 40"
[[nodiscard]] std::string hidden_in_short(const SensorChoice& choice);

}  // namespace tactile_net::lab
