/// @file
/// What a scene's contacts do to its sensors, frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/sensing/spectral.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {

/// A scene's sensor, gone through from the first frame to the scene's; only the effects that the
/// scene names are simulated.
class SensorRecording {
 public:
  /// Keeps a copy of the scene.
  explicit SensorRecording(Scene scene);

  /// Goes on to the next frame; false if there is none.
  ///
  /// @param wanted  false: the readings hold nothing of use, which saves the forward model where no
  ///                effect remembers
  [[nodiscard]] bool next(bool wanted = true);

  /// Of the frame last taken: t [s], the readings, channels x count, what pressed at that moment,
  /// and what the effects have to say.
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] std::span<const double> readings() const noexcept { return readings_; }
  [[nodiscard]] const TractionField& truth() const noexcept { return truth_; }
  [[nodiscard]] std::vector<CutOffNote> notes() const { return path_.notes(); }

 private:
  void load(double time);

  Scene scene_;
  std::vector<Instant> instants_;
  std::size_t next_ = 0;
  SignalPath path_;
  std::optional<SampledModel> model_;  // sampled forward model
  bool loaded_ = false;                // truth and pure readings are those of contacts that stand
  std::vector<double> pure_;
  double time_ = 0.0;
  std::vector<double> readings_;
  TractionField truth_;
};

/// What a user should know of a scene's readings before trusting the rest.
namespace remark {
/// Contacts drag, and one traction alone is solved for: the drag is taken for normal traction.
struct FrictionUnseen {};
struct ForceBeyondEnds {
  double share = 0.0;  ///< of the normal force, where no taxel sits above it
};
struct NoContact {};  ///< the readings are noise, and so is an alpha that a rule chooses on them
}  // namespace remark
using SceneRemark =
    std::variant<remark::FrictionUnseen, remark::ForceBeyondEnds, remark::NoContact>;

/// The scene's frame.
struct SimulatedFrame {
  TractionField truth{};
  std::vector<double> readings{};  ///< channels x count
  double force = 0.0;              ///< normal, of all contacts, exact [N/m]
  std::vector<SceneRemark> remarks{};
  std::vector<CutOffNote> notes{};  ///< what the effects have to say
};

/// @param observer  hears of every frame up to the scene's
[[nodiscard]] SimulatedFrame simulate(const Scene& scene, Observer& observer = silent);

}  // namespace tactile_net::lab
