/// @file
/// What every method of a study starts from: one frame, its exact solution, and what noise does.
#pragma once

#include <vector>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::study {

struct StudyInput {
  lab::SceneProblem problem{Scene{}};
  double alpha = 0.0;  ///< the scene's or its rule's: all methods share it
  TractionField truth{};
  std::vector<double> readings{};
  /// f*, of a QR, without the scene's constraints; `agreement` from the one by singular values.
  std::vector<double> solution{};
  double agreement = 0.0;
  double solution_error = 0.0;  ///< |f* - truth| / |truth|; NaN without a contact
  double noise_rms = 0.0;       ///< of a reading, as for `noise_floor`
  bool noise_stated = false;    ///< by the scene; else one hundredth of the largest reading
  double noise_floor = 0.0;     ///< what that noise does to f*: root mean square, over |f*|

  [[nodiscard]] const Scene& scene() const noexcept { return problem.scene(); }

  /// The smallest error that can be told: both references may err by more than they differ.
  [[nodiscard]] double resolution() const noexcept { return 10.0 * agreement; }
};

/// @throw std::invalid_argument  the scene cannot be studied: every reading is zero, ...
[[nodiscard]] StudyInput study_input(const Scene& scene);

}  // namespace tactile_net::study
