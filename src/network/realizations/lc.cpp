/// @file
/// As `ideal`, at one frequency w: a capacitor g/w for every conductance g > 0, an inductor
/// 1/(w|g|) for every g < 0, currents of phase 90 degrees. Node voltages are real. Lossless: it
/// never settles.

#include "network/angular_frequency.hpp"
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"

namespace tactile_net {
namespace {

Circuit lc_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  const ConductanceNetwork network = conductances(problem.matrix);
  RealizationOptions at_one_frequency = options;
  at_one_frequency.node_capacitance.reset();  // it would be one more conductance
  Circuit circuit = driven_nodes(network, problem.right_side, at_one_frequency);
  const double w = angular_frequency(options.frequency);
  const auto add = [&](const std::string& name, Node from, Node to, double siemens) {
    if (siemens > 0.0)
      circuit.capacitors.push_back({"C" + name, from, to, siemens / w});
    else if (siemens < 0.0)
      circuit.inductors.push_back({"L" + name, from, to, -1.0 / (w * siemens)});
  };
  each_conductance(network, circuit, options.scale.siemens, add);
  return circuit;
}

}  // namespace

constexpr RealizationTraits lc_traits{
    .realization = Realization::lc,
    .parts = RealizationTraits::Parts::lossless,
    .theorem = {"passive", "Passive parts cannot be unstable; lossless ones never settle.", {}},
    .build = lc_circuit};

}  // namespace tactile_net
