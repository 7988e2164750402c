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
#include "tactile_net/skin/load.hpp"

namespace tactile_net::lab {

/// A scene's sensor, gone through from the first frame to the scene's; only the effects that the
/// scene names are simulated.
template <SceneKind Kind>
class SensorWalk {
 public:
  SensorWalk(const SensorWalk&) = delete;
  SensorWalk& operator=(const SensorWalk&) = delete;
  virtual ~SensorWalk() = default;

  /// Goes on to the next frame; false if there is none.
  ///
  /// @param wanted  false: the readings hold nothing of use, which saves the forward model where no
  ///                effect remembers
  /// @throw  as the forward model
  [[nodiscard]] bool next(bool wanted = true);

  /// Of the frame last taken: t [s], the readings, and what the effects have to say.
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] std::span<const double> readings() const noexcept { return readings_; }
  [[nodiscard]] std::vector<CutOffNote> notes() const { return path_.notes(); }

 protected:
  /// Keeps a copy of the scene.
  explicit SensorWalk(Kind scene);
  [[nodiscard]] const Kind& scene() const noexcept { return scene_; }

 private:
  /// The readings that contacts cause before all effects; notes what presses.
  virtual std::vector<double> press(const decltype(Kind::contacts)& contacts) = 0;

  Kind scene_;
  std::vector<Instant> instants_;
  std::size_t next_ = 0;  // of the instants
  SignalPath path_;
  double time_ = 0.0;
  std::vector<double> pure_{};  // of contacts that stand; empty: not known
  std::vector<double> readings_{};
};

/// A line's.
class SensorRecording final : public SensorWalk<Scene> {
 public:
  explicit SensorRecording(Scene scene);
  /// What pressed at the frame last taken.
  [[nodiscard]] const TractionField& truth() const noexcept { return truth_; }

 private:
  std::vector<double> press(const std::vector<Contact>& contacts) override;

  std::optional<SampledModel> model_{};  // sampled forward model
  TractionField truth_{};
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

/// The frame of a scene, of a line or a skin.
struct SimulatedFrame {
  /// Component after component [Pa]: of a line at its places, the tangential ones where something
  /// drags; of a skin three, means over its cells. Empty: nobody knows, as of a recording.
  std::vector<double> truth{};
  std::vector<double> readings{};  ///< in the order of the sensor's readings
  double force = 0.0;              ///< normal, of all contacts, exact [N/m, of a skin N]
  SkinWrench wrench{};             ///< of a skin: of all contacts, exact
  std::vector<SceneRemark> remarks{};
  std::vector<CutOffNote> notes{};  ///< what the effects have to say
};

/// @param observer  hears of every frame up to the scene's
[[nodiscard]] SimulatedFrame simulate(const Scene& scene, Observer& observer = silent);

}  // namespace tactile_net::lab
