/// @file
/// How a scene's circuit follows contacts that move.
#pragma once

#include <optional>

#include "tactile_net/lab/scene_circuit.hpp"

namespace tactile_net::lab {

/// Of the scene's contacts together, along y, while the circuit's op-amps do not slew.
struct ContactMotion {
  /// What counts as behind, of the answer, and the loop that a circuit is compared with.
  static constexpr double lag = 0.01;
  static constexpr double sampling_hertz = 1000.0;

  double delay = 0.0;          ///< what the circuit is behind steadily moving contacts [s]
  double speed = 0.0;          ///< at which that is `lag` of the answer [m/s]
  double slowest_hertz = 0.0;  ///< up to which its slowest direction follows, -3 dB
  /// The speed at which an answer that is sampled and held at `sampling_hertz` is up to `lag` off,
  /// with nothing else to wait for [m/s].
  double sampled_speed = 0.0;
};

/// Absent: there is no contact, nothing in the circuit takes time, or it does not settle.
[[nodiscard]] std::optional<ContactMotion> contact_motion(const SceneCircuit& circuit);

}  // namespace tactile_net::lab
