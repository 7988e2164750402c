/// @file
/// What a skin's contacts do to its sensors, frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net::lab {

/// A skin's frames.
class SkinRecording final : public SensorWalk<SkinScene> {
 public:
  /// @throw std::invalid_argument  as `grid` and `ExactSkinModel`
  explicit SkinRecording(SkinScene scene);

  /// Of the frame last taken: the mean tractions of the grid's cells [Pa], three components, and
  /// what presses.
  [[nodiscard]] const std::vector<double>& truth() const noexcept { return truth_; }
  [[nodiscard]] const std::vector<SkinLoad>& contacts() const noexcept { return contacts_; }

 private:
  std::vector<double> press(const std::vector<SkinLoad>& contacts) override;

  SurfaceGrid grid_;
  std::optional<ExactSkinModel> exact_{};      // of the two forward models
  std::optional<SampledSkinModel> sampled_{};  // that which the scene has
  std::vector<SkinLoad> contacts_{};
  std::vector<double> truth_{};
};

/// @param observer  hears of every frame up to the scene's
[[nodiscard]] SimulatedFrame simulate(const SkinScene& scene, Observer& observer = silent);

}  // namespace tactile_net::lab
