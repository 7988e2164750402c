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

/// A skin gone through from the first frame to the scene's, as `SensorRecording` does lines: only
/// the effects that the scene names are simulated.
class SkinRecording {
 public:
  /// Keeps a copy of the scene.
  /// @throw std::invalid_argument  as `grid` and `ExactSkinModel`
  explicit SkinRecording(SkinScene scene);

  /// Goes on to the next frame; false if there is none.
  ///
  /// @param wanted  false: the readings hold nothing of use, which saves the forward model where no
  ///                effect remembers
  /// @throw std::invalid_argument, std::runtime_error  as `ExactSkinModel::readings`
  [[nodiscard]] bool next(bool wanted = true);

  /// Of the frame last taken: t [s], the readings, the mean tractions of the grid's cells [Pa],
  /// three components, what presses, and what the effects have to say.
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] std::span<const double> readings() const noexcept { return readings_; }
  [[nodiscard]] const std::vector<double>& truth() const noexcept { return truth_; }
  [[nodiscard]] const std::vector<SkinLoad>& contacts() const noexcept { return contacts_; }
  [[nodiscard]] std::vector<CutOffNote> notes() const { return path_.notes(); }

 private:
  void load(double time);

  SkinScene scene_;
  SurfaceGrid grid_;
  std::vector<Instant> instants_;
  std::size_t next_ = 0;
  SignalPath path_;
  std::optional<ExactSkinModel> exact_{};      // of the two forward models
  std::optional<SampledSkinModel> sampled_{};  // that which the scene has
  double time_ = 0.0;
  bool loaded_ = false;  // truth and pure readings are those of contacts that stand
  std::vector<SkinLoad> contacts_{};
  std::vector<double> truth_{};
  std::vector<double> pure_{};
  std::vector<double> readings_{};
};

/// The scene's frame.
struct SkinFrame {
  std::vector<double> truth{};     ///< three components of every cell [Pa], means over it
  std::vector<double> readings{};  ///< in the order of the skin's readings
  SkinWrench wrench{};             ///< of all contacts, exact
  std::vector<SceneRemark> remarks{};
  std::vector<CutOffNote> notes{};  ///< what the effects have to say
};

/// @param observer  hears of every frame up to the scene's
[[nodiscard]] SkinFrame simulate(const SkinScene& scene, Observer& observer = silent);

}  // namespace tactile_net::lab
