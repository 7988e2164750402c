#include "commands/network_options.hpp"

#include <ostream>
#include <variant>

#include "failure.hpp"
#include "tactile_net/lab/circuit_options.hpp"

namespace tactile_net::tool {

void apply(const NetworkOptions& network, tactile_net::NetworkOptions& of_scene,
           std::ostream& err) {
  if (network.realization) of_scene.realization = *network.realization;
  if (!network.bandwidth) return;
  if (!(*network.bandwidth >= 1e-3 && *network.bandwidth <= 1e15))
    throw WrongUsage("--bandwidth", "must be from 1e-3 to 1e15 Hz");
  if (!has_amplifiers(of_scene.realization))
    err << "note: " << name(of_scene.realization)
        << " has no op-amps: --bandwidth changes nothing\n";
  lab::give_bandwidth(of_scene, *network.bandwidth);
}

AnyScene circuit_scene(const InputText& text, const NetworkOptions& network,
                       const Streams& streams) {
  AnyScene any = parse_any_scene(text.text, text.name);
  std::visit([&](auto& scene) { apply(network, scene.network, streams.err); }, any);
  return any;
}

AnyScene read_circuit_scene(const std::string& path, const NetworkOptions& network,
                            const Streams& streams) {
  return circuit_scene(input_text(path, streams.in), network, streams);
}

}  // namespace tactile_net::tool
