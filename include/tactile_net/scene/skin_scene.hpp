/// @file
/// A scene of a skin as plain data: an array of taxels in two dimensions, pressed and dragged in
/// three. Line arrays are `Scene` (scene.hpp); `read_any_scene` (reader.hpp) tells them apart.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/timing.hpp"
#include "tactile_net/scene/units.hpp"
#include "tactile_net/sensing/calibration.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"
#include "tactile_net/skin/load.hpp"
#include "tactile_net/skin/moving_contact.hpp"

namespace tactile_net {

struct SkinReconstructOptions {
  std::optional<double> alpha{};             ///< absent: a rule chooses it
  std::optional<AlphaRule> alpha_rule{};     ///< absent: by readings and noise
  std::optional<double> smoothing_length{};  ///< l [m]; absent: the mean depth of the taxels
  /// How much heavier the tangential tractions' stabiliser is, > 0; absent: as each frame's
  /// readings have it (inverse/tangential_weight.hpp).
  std::optional<double> tangential_weight = 1.0;
  SkinGridOptions grid{};                  ///< where the tractions lie
  std::optional<bool> tangential{};        ///< solve for the drags too; absent: see `components`
  bool nonnegative = false;                ///< p >= 0
  std::optional<double> friction_limit{};  ///< |q| <= limit p; implies p >= 0
  bool offset = false;  ///< each channel's readings have a constant that is not known
};

/// `SensorEffects` lie between the pad and the file.
struct SkinScene : SensorEffects {
  std::string file{};   ///< name of the file, without its folder
  std::string title{};  ///< optional `title` at the top of the file
  /// Present: every number below is in SI, whatever the file has; its force is in newtons. Absent:
  /// any consistent set.
  std::optional<Units> units{};
  SkinArray sensor{};
  Material material{};
  std::optional<Timing> time{};      ///< absent: one frame, of loads that have always been there
  std::size_t frame = 0;             ///< that `run` reconstructs: the reader sets the last
  std::vector<SkinLoad> contacts{};  ///< as they are at that frame
  std::vector<SkinContactTrajectory> trajectories{};  ///< one per contact, empty where it stands
  /// As of a line's scene: [calibration] and [units] in one.
  std::optional<Calibration> calibration{};
  ForwardModel forward = ForwardModel::exact;
  SkinReconstructOptions reconstruct{};
  NetworkOptions network{};
};

/// How many tractions of a cell a scene solves for: 3, normal and two tangential, if the skin has
/// more than one channel and the scene calls for them: by `tangential`, by a friction limit, by a
/// contact that drags at any time, or by having no contact, as scenes for recorded readings. Else
/// 1, the normal one.
[[nodiscard]] std::size_t components(const SkinScene& scene);

/// Where those tractions lie. @throw std::invalid_argument  as `grid_of`
[[nodiscard]] SurfaceGrid grid(const SkinScene& scene);

/// The same scene, its cells as large as what the circuit's nodes stand for.
[[nodiscard]] SkinScene of_circuit(SkinScene scene);

/// Tractions that a skin is solved for, at most: their matrices are dense.
inline constexpr std::size_t most_skin_tractions = 8192;

/// A contact drags at any time.
[[nodiscard]] bool any_drag(const SkinScene& scene);

/// The stages that the scene's effects put between the pad and the file, at rest.
[[nodiscard]] SignalPath signal_path(const SkinScene& scene);

/// As of a line's scene: the moments at which the sensor is gone through up to the scene's frame.
[[nodiscard]] std::vector<Instant> instants(const SkinScene& scene);

/// Every contact at time t [s], those that stand still as they are.
[[nodiscard]] std::vector<SkinLoad> contacts_at(const SkinScene& scene, double t);

/// The same scene with another frame to be reconstructed: its contacts are those of that moment.
///
/// @throw std::invalid_argument  there is no such frame
[[nodiscard]] SkinScene at_frame(SkinScene scene, std::size_t frame);

/// Readings as a file of this scene has them: in its units, before its calibration.
[[nodiscard]] std::vector<double> raw_numbers(const SkinScene& scene,
                                              std::span<const double> readings);

}  // namespace tactile_net
