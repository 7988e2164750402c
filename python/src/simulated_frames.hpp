/// @file
/// What a scene's sensor reads, frame by frame, and what pressed.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::python {

struct SimulatedFrames {
  std::vector<double> t{};         ///< of each [s]
  std::vector<double> readings{};  ///< frames x readings
  /// Frames x components x places: of a line normal and tangential tractions, of a skin three.
  std::vector<double> truth{};
  std::vector<std::string> notes{};  ///< what the effects have to say

  [[nodiscard]] std::size_t count() const noexcept { return t.size(); }
};

/// All frames. @pre the GIL is not held
[[nodiscard]] SimulatedFrames simulated_frames(const Scene& scene, lab::Observer& observer);
[[nodiscard]] SimulatedFrames simulated_frames(const SkinScene& scene, lab::Observer& observer);

/// K of a scene as if nothing were known of its noise, and no taxel dead.
[[nodiscard]] Matrix plain_kernel(const Scene& scene);
[[nodiscard]] Matrix plain_kernel(const SkinScene& scene);

}  // namespace tactile_net::python
