/// @file
/// What a scene's sensors can tell, beside what others in their place could.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::tool {

/// One choice of quantities and depths.
struct SensorChoice {
  std::vector<Quantity> reads{};
  std::vector<double> depths{};
  std::size_t unknowns = 1;  ///< 2 if there is more than one channel
  Identifiability identifiability{};
  std::vector<Resolution> resolutions{};
  std::optional<double> normal{};      ///< resolvable wavelength [m]
  std::optional<double> tangential{};  ///< the same; absent with one unknown too
};

struct SurveyOptions {
  std::optional<double>
      traction{};                ///< a ripple's amplitude [Pa]; absent: the contacts' peak, or 1
  double relative_noise = 0.01;  ///< over the largest reading of it, where the scene has no rms
};

struct Survey {
  SensorChoice own{};
  std::vector<SensorChoice> alternatives{};
  double traction = 1.0;
  std::string noise{};  ///< which noise was assumed, in words
};

[[nodiscard]] Survey survey(const Scene& scene, const SurveyOptions& options);

/// "stress_x, shear_xy at 1.5"
[[nodiscard]] std::string in_words(const SensorChoice& choice);

/// What the sensors cannot tell, and why, and what to read instead; one sentence each.
[[nodiscard]] std::vector<std::string> verdict_in_words(const Survey& survey, const Scene& scene);

/// Header and rows of the comparison, the scene's own sensors first.
[[nodiscard]] std::vector<std::vector<std::string>> survey_cells(const Survey& survey);

}  // namespace tactile_net::tool
