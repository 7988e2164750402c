/// @file
/// What realisations begin with: nodes, sources and kinds of amplifiers. Private.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "numeric/finite.hpp"
#include "tactile_net/network/realization.hpp"

namespace tactile_net {

/// Nodes n0, n1, ... (indices 1, 2, ...) with the current sources I0, I1, ... and the capacitances
/// C0, C1, ... if there are any.
/// @throw std::invalid_argument  sizes differ, a value is not finite, an option is out of range
[[nodiscard]] inline Circuit driven_nodes(const ConductanceNetwork& network,
                                          std::span<const double> right_side,
                                          const RealizationOptions& options) {
  if (right_side.size() != network.nodes || network.ground.size() != network.nodes)
    throw std::invalid_argument("the network needs one current and one ground value per node");
  if (!all_finite(right_side)) throw std::invalid_argument("the currents must be finite");
  check(options);

  Circuit circuit;
  circuit.divider = options.divider;
  for (std::size_t i = 0; i < network.nodes; ++i) {
    const std::string index = std::to_string(i);
    circuit.outputs.push_back(add_node(circuit, "n" + index));
    circuit.sources.push_back({"I" + index, circuit.outputs[i],
                               options.scale.siemens * options.scale.volts * right_side[i]});
    if (options.node_capacitance)
      circuit.capacitors.push_back({"C" + index, circuit.outputs[i], 0, *options.node_capacitance});
  }
  circuit.resistors.reserve(network.branches.size() + network.nodes);
  return circuit;
}

[[nodiscard]] inline std::string branch_name(const Branch& branch) {
  return std::to_string(branch.from) + "_" + std::to_string(branch.to);
}

/// Calls `add(name, from, to, siemens)` for every branch and every ground conductance that is not
/// zero: "0_1", ..., "g0", ...
void each_conductance(const ConductanceNetwork& network, const Circuit& circuit, double siemens,
                      const auto& add) {
  for (const Branch& branch : network.branches)
    add(branch_name(branch), circuit.outputs[branch.from], circuit.outputs[branch.to],
        siemens * branch.conductance);
  for (std::size_t i = 0; i < network.nodes; ++i)
    if (network.ground[i] != 0.0)
      add("g" + std::to_string(i), circuit.outputs[i], 0, siemens * network.ground[i]);
}

/// A conductance from a node to ground: a resistor, or a converter and one where it is negative.
inline void add_ground(Circuit& circuit, std::size_t index, double siemens) {
  const std::string name = std::to_string(index);
  const Node node = circuit.outputs[index];
  if (siemens > 0.0) {
    circuit.resistors.push_back({"Rg" + name, node, 0, siemens});
  } else if (siemens < 0.0) {
    const Node out = add_node(circuit, "g" + name);
    circuit.instances.push_back({"Xg" + name, {node, out}, "grounded_nic"});
    circuit.resistors.push_back({"Rg" + name, node, out, -siemens});
  }
}

/// An amplifier around a summing node, and where to take its output from with either sign.
struct Signed {
  Node summing = 0;
  Node plus = 0;
  Node minus = 0;  ///< -plus
};

/// The amplifier of these nodes, X and the name of its output; its inverse is a second output, or
/// an inverter. The models "amplifier", or "opamp" and "main_opamp", must be in the circuit.
inline void add_driver(Circuit& circuit, Node input, const Signed& one, const std::string& model,
                       bool inverters) {
  const std::string name = "X" + circuit.nodes[one.plus];
  if (inverters) {
    circuit.instances.push_back({name, {input, one.summing, one.plus}, model});
    circuit.instances.push_back(
        {"X" + circuit.nodes[one.minus], {one.plus, one.minus}, "inverter"});
  } else {
    circuit.instances.push_back({name, {input, one.summing, one.plus, one.minus}, model});
  }
}

/// An amplifier, its '+' grounded, with its summing node.
[[nodiscard]] inline Signed add_amplifier(Circuit& circuit, const std::string& summing,
                                          const std::string& output, const std::string& inverse,
                                          const std::string& model, bool inverters) {
  const Signed one{add_node(circuit, summing), add_node(circuit, output),
                   add_node(circuit, inverse)};
  add_driver(circuit, 0, one, model, inverters);
  return one;
}

/// A reading into a node: a current, or that current's voltage behind a resistor of a node's own.
///
/// @param ampere   at a node of 0 V
/// @param siemens  of the resistor; 0: it is a current
inline void add_reading(Circuit& circuit, const std::string& name, Node into, double ampere,
                        double siemens) {
  if (siemens == 0.0) {
    circuit.sources.push_back({"I" + name, into, ampere});
    return;
  }
  const Node from = add_node(circuit, "g" + name);
  circuit.resistors.push_back({"Ri" + name, from, into, siemens});
  circuit.sources.push_back({"V" + name, from, 0.0, ampere / siemens});
}

/// A conductance of either sign from an amplifier's output into a summing node.
inline void add_signed(Circuit& circuit, std::string name, const Signed& from, Node summing,
                       double siemens) {
  if (siemens == 0.0) return;
  circuit.resistors.push_back({std::move(name), siemens > 0.0 ? from.plus : from.minus, summing,
                               siemens > 0.0 ? siemens : -siemens});
}

/// The kinds of amplifiers of what drives its nodes; returns the main ones' model.
inline std::string add_models(Circuit& circuit, Realization realization,
                              const RealizationOptions& options) {
  const Outputs outputs = options.inverters ? Outputs::single : Outputs::complementary;
  std::string others = options.inverters ? "opamp" : "amplifier";
  OpAmp opamp = options.opamp;
  if (options.node_capacitance && has_nodes_at_outputs(realization, options))
    opamp.load_capacitance = opamp.load_capacitance.value_or(0.0) + *options.node_capacitance;
  circuit.amplifiers.push_back({others, opamp, outputs});
  const double ratio = options.main_bandwidth(realization);
  if (ratio == 1.0 || !options.opamp.bandwidth) return others;
  OpAmp main = opamp;
  main.bandwidth = ratio * *main.bandwidth;
  circuit.amplifiers.push_back({"main_" + others, main, outputs});
  return "main_" + others;
}

}  // namespace tactile_net
