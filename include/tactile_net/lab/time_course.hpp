/// @file
/// The contact's resultant over a scene's time: as it presses, and as a method finds it.
#pragma once

#include <optional>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/numeric/distribution.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {

/// Absent: it was not solved for, or not known.
struct ResultantIntervals {
  std::optional<CentralInterval> normal{}, tangential{}, centre{};
};

struct TimeCourse {
  Method method = Method::tikhonov;
  bool tangential = false;     ///< the method solves for it
  std::vector<double> time{};  ///< [s]
  std::vector<Resultant>
      truth{};  ///< the contacts' exact forces; the place as sampled at the taxels
  std::vector<Resultant> found{};  ///< NaN where a frame has no answer
  /// Of every frame at the scene's level, which `found` is then the mean of: where the scene is
  /// answered by its mixture; else none.
  std::vector<ResultantIntervals> intervals{};
  /// Normal, then tangential, of every frame, one frame after another [Pa]; NaN as above.
  std::vector<double> tractions{};
};

/// Every frame by itself, as `solve` does; of more than 400 frames every second, third, ...
///
/// @pre  the scene has a time, and the method is tikhonov or closed_form
/// @throw std::invalid_argument, std::domain_error  as `make_solver`
[[nodiscard]] TimeCourse time_course(const SceneProblem& problem, Method method,
                                     Observer& observer = silent);

}  // namespace tactile_net::lab
