#include <algorithm>
#include <array>
#include <stdexcept>

#include "network/node_names.hpp"
#include "network/realizations/traits.hpp"
#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr std::array table = {
    &ideal_traits,         &nic_traits,     &rail_traits, &crossbar_traits,
    &least_squares_traits, &lattice_traits, &lc_traits,   &ndr_traits};
static_assert(table.size() == realizations.size(), "one row per realisation");

}  // namespace

const RealizationTraits& traits(Realization realization) noexcept {
  return **std::find_if(table.begin(), table.end(), [=](const RealizationTraits* one) {
    return one->realization == realization;
  });
}

std::string_view name(Realization realization) noexcept {
  return name_in<Enumerators<Realization>::all>(realization);
}

std::optional<Realization> realization_named(std::string_view text) noexcept {
  return named_in<Enumerators<Realization>::all>(text);
}

bool has_nodes_at_outputs(Realization realization, const RealizationOptions& options) noexcept {
  const RealizationTraits& one = traits(realization);
  return one.drives_nodes && !one.passive_residuals && !has_ladder(realization, options);
}

bool has_ladder(Realization realization, const RealizationOptions& options) noexcept {
  return options.ladder && !traits(realization).theorem_with_ladder.name.empty();
}

bool has_amplifiers(Realization realization) noexcept { return traits(realization).uses_opamps; }

double RealizationOptions::main_bandwidth(Realization realization) const noexcept {
  if (bandwidth_ratio) return *bandwidth_ratio;
  const RealizationTraits& one = traits(realization);
  return inverters && one.bandwidth_ratio != nullptr ? one.bandwidth_ratio(*this) : 1.0;
}

bool takes_time(Realization realization, const RealizationOptions& options) noexcept {
  const RealizationTraits& one = traits(realization);
  if (one.uses_opamps) return options.opamp.bandwidth.has_value();
  return one.parts != RealizationTraits::Parts::lossless &&
         (options.node_capacitance || options.resistor_capacitance);
}

Circuit realize(Realization realization, const NetworkProblem& problem,
                const RealizationOptions& options) {
  if (options.inputs == Inputs::voltage && !traits(realization).drives_nodes)
    throw std::invalid_argument(
        "readings come as voltages where op-amps drive the nodes: in " +
        std::string(name(realization)) +
        " their resistors would load the answer; take crossbar, least_squares or lattice");
  Circuit circuit = traits(realization).build(problem, options);
  if (options.resistor_capacitance)
    for (const Resistor& one : circuit.resistors)
      circuit.capacitors.push_back(
          {'C' + one.name, one.from, one.to, *options.resistor_capacitance});
  if (problem.names.empty()) return circuit;
  if (problem.names.size() != circuit.outputs.size())
    throw std::invalid_argument("a circuit's nodes need a name each, or none");
  for (std::size_t i = 0; i < problem.names.size(); ++i)
    circuit.nodes[circuit.outputs[i]] = problem.names[i];
  check_node_names(circuit);
  return circuit;
}

}  // namespace tactile_net
