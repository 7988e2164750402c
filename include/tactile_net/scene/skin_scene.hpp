/// @file
/// A scene of a skin as plain data: an array of taxels in two dimensions, pressed and dragged in
/// three. Line arrays are `Scene` (scene.hpp); `read_any_scene` (reader.hpp) tells them apart.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/sensing/surface_cells.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"
#include "tactile_net/skin/load.hpp"
#include "tactile_net/skin/moving_contact.hpp"

namespace tactile_net {

struct SkinReconstructOptions : SharedReconstructOptions {
  std::optional<double> smoothing_length{};  ///< l [m]; absent: the mean depth of the taxels
  SkinGridOptions grid{};                    ///< where the tractions lie
  SpaceVector moment_about{};                ///< of a curved skin, in the sensor's axes [m]
};

/// With units, its force is in newtons.
struct SkinScene : SharedScene {
  SkinArray sensor{};
  std::vector<SkinLoad> contacts{};                   ///< as they are at that frame
  std::vector<SkinContactTrajectory> trajectories{};  ///< one per contact, empty where it stands
  SkinReconstructOptions reconstruct{};
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

}  // namespace tactile_net
