#include "commands/network_options.hpp"

#include <ostream>

#include "failure.hpp"
#include "tactile_net/lab/circuit_options.hpp"

namespace tactile_net::tool {

void apply(const NetworkOptions& network, Scene& scene, std::ostream& err) {
  if (network.realization) scene.network.realization = *network.realization;
  if (!network.bandwidth) return;
  if (!(*network.bandwidth >= 1e-3 && *network.bandwidth <= 1e15))
    throw WrongUsage("--bandwidth", "must be from 1e-3 to 1e15 Hz");
  const Realization realization = scene.network.realization;
  if (!has_amplifiers(realization))
    err << "note: " << name(realization) << " has no op-amps: --bandwidth changes nothing\n";
  lab::give_bandwidth(scene, *network.bandwidth);
}

}  // namespace tactile_net::tool
