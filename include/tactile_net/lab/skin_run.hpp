/// @file
/// The main job for a skin: scene -> readings -> tractions -> comparison with the truth.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/skin_answer.hpp"
#include "tactile_net/lab/skin_simulation.hpp"

namespace tactile_net::lab {

struct SkinExperiment {
  SkinScene scene{};
  SkinGrid grid{};
  SkinFrame frame{};                   ///< of a recording without `truth`, which nobody knows
  std::optional<SkinAnswer> answer{};  ///< absent: `refusal` says why
  std::string refusal{};
  /// Of p, q_y and q_z: root mean square of answer - truth over that of the true p; NaN where
  /// nothing presses or the component was not solved for.
  std::array<double, 3> relative{};
  double setup_seconds = 0.0;  ///< until a frame can be solved; NaN: not timed
  double frame_seconds = 0.0;  ///< of a frame with all that is said of it

  [[nodiscard]] bool has_truth() const noexcept { return !frame.truth.empty(); }
  [[nodiscard]] bool succeeded() const noexcept {
    return answer && answer->verdict != Verdict::failed;
  }
};

/// A scene that cannot be solved is a result that says so.
///
/// @param clock  seconds since any moment; absent: nothing is timed
/// @throw std::invalid_argument, std::runtime_error  the readings cannot be simulated
[[nodiscard]] SkinExperiment run(const SkinScene& scene, const std::function<double()>& clock = {},
                                 Observer& observer = silent);

}  // namespace tactile_net::lab
