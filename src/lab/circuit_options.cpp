#include "tactile_net/lab/circuit_options.hpp"

namespace tactile_net::lab {

void give_bandwidth(Scene& scene, double hertz) {
  OpAmp& opamp = scene.network.parts.opamp;
  opamp.gain = opamp.dc_gain();
  opamp.bandwidth = hertz;
  if (!scene.network.settling_accuracy) scene.network.settling_accuracy = 1e-3;
}

}  // namespace tactile_net::lab
