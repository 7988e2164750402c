/// @file
/// The main job for a skin: scene -> readings -> tractions -> comparison with the truth.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/skin_simulation.hpp"

namespace tactile_net::lab {

/// What the simulator makes of the scene's circuit, beside the same truth.
struct SkinCircuitResult {
  std::optional<SceneCircuit> circuit{};   ///< absent: `refusal` says why
  std::optional<Relaxation> relaxation{};  ///< absent: so too
  std::array<double, 3> relative{};        ///< as the answer's, of what the nodes stand for
  std::string refusal{};

  [[nodiscard]] Verdict verdict() const noexcept {
    return relaxation ? relaxation->verdict() : Verdict::failed;
  }
};

struct SkinExperiment {
  SkinScene scene{};
  SurfaceGrid grid{};
  SkinFrame frame{};                    ///< of a recording without `truth`, which nobody knows
  std::optional<FrameAnswer> answer{};  ///< absent: `refusal` says why
  std::string refusal{};
  /// Of p, q_y and q_z: root mean square of answer - truth over that of the true p; NaN where
  /// nothing presses or the component was not solved for.
  std::array<double, 3> relative{};
  double setup_seconds = 0.0;                  ///< until a frame can be solved; NaN: not timed
  double frame_seconds = 0.0;                  ///< of a frame with all that is said of it
  std::optional<SkinCircuitResult> network{};  ///< absent: nobody has asked, `run_circuit`

  [[nodiscard]] bool has_truth() const noexcept { return !frame.truth.empty(); }
  [[nodiscard]] bool succeeded() const noexcept {
    return answer && answer->verdict != Verdict::failed &&
           (!network || network->verdict() != Verdict::failed);
  }
};

/// A scene that cannot be solved is a result that says so.
///
/// @param clock  seconds since any moment; absent: nothing is timed
/// @throw std::invalid_argument, std::runtime_error  the readings cannot be simulated
[[nodiscard]] SkinExperiment run(const SkinScene& scene, const std::function<double()>& clock = {},
                                 Observer& observer = silent);

/// The scene's circuit for the experiment's own readings, run by the simulator: `network` is filled
/// in. A scene that makes no circuit, and a simulator that fails, are results that say so.
void run_circuit(SkinExperiment& experiment, Simulator& simulator, Observer& observer = silent);

}  // namespace tactile_net::lab
