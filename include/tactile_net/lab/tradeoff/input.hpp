/// @file
/// What every method of a study starts from: one frame, its exact solution, and what noise does.
#pragma once

#include <vector>

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {

struct StudyInput {
  Scene scene;  ///< with the alpha that all methods share
  TractionField truth{};
  std::vector<double> readings{};
  std::vector<double> solution{};  ///< f*, of a QR; `agreement` from the one by singular values
  double agreement = 0.0;
  double solution_error = 0.0;  ///< |f* - truth| / |truth|; NaN without a contact
  bool constrained = false;     ///< the scene has constraints, which f* does not know
  double noise_rms = 0.0;       ///< of a reading, as for `noise_floor`
  bool noise_stated = false;    ///< by the scene; else one hundredth of the largest reading
  double noise_floor = 0.0;     ///< what that noise does to f*: root mean square, over |f*|

  /// The smallest error that can be told: both references may err by more than they differ.
  [[nodiscard]] double resolution() const noexcept { return 10.0 * agreement; }
};

/// @throw std::invalid_argument  the scene cannot be studied: every reading is zero, ...
[[nodiscard]] StudyInput study_input(const Scene& scene);

}  // namespace tactile_net::lab
