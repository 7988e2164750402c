#include "tactile_net/lab/circuit_options.hpp"

namespace tactile_net::lab {

void give_bandwidth(NetworkOptions& network, double hertz) {
  OpAmp& opamp = network.parts.opamp;
  opamp.gain = opamp.dc_gain();
  opamp.bandwidth = hertz;
  if (!network.settling_accuracy) network.settling_accuracy = 1e-3;
}

}  // namespace tactile_net::lab
