/// @file
/// A circuit as plain data: what a realisation builds, the deck writer prints, and the certificate
/// takes its equations from.
///
///     const NetworkProblem network = network_problem(problem, alpha, readings);
///     const Circuit circuit = realize(Realization::nic, network);  // realization.hpp
///     count_elements(circuit).opamps;  // flat_circuit.hpp; examples/05_deck.cpp
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/network/opamp.hpp"

namespace tactile_net {

/// Index into `Circuit::nodes`; 0 is ground.
using Node = std::size_t;

struct Resistor {
  std::string name{};  ///< begins with R
  Node from = 0;
  Node to = 0;
  double siemens = 0.0;  ///< not 0; negative: a negative resistor
};

struct Capacitor {
  std::string name{};  ///< begins with C
  Node from = 0;
  Node to = 0;
  double farad = 0.0;  ///< > 0
};

struct Inductor {
  std::string name{};  ///< begins with L
  Node from = 0;
  Node to = 0;
  double henry = 0.0;  ///< > 0
};

/// What a reading drives a node with: a current from ground into it, or a voltage.
struct CurrentSource {
  std::string name{};  ///< begins with I, of a voltage with V
  Node into = 0;
  double ampere = 0.0;            ///< 0 of a voltage
  std::optional<double> volts{};  ///< what it holds the node at [V]; absent: it is a current
};

/// A two-terminal device with an N-shaped characteristic, of slope -siemens at 0 V and no steeper
/// anywhere.
enum class Curve {
  cubic,         ///< i = -g v (1 - (v/V)^2)
  tunnel_diode,  ///< i = g V ((2 + u) exp(-u) - 2), u = v/V: i = I u exp(1 - u) biased at u = 2
};
struct NShapedDevice {
  std::string name{};  ///< begins with B
  Node from = 0;
  Node to = 0;
  double siemens = 0.0;  ///< g, > 0
  double volts = 1.0;    ///< V, > 0
  Curve curve = Curve::cubic;
};

/// One use of a sub-circuit from `subcircuits.hpp` or of an amplifier model of this circuit.
struct Instance {
  std::string name{};  ///< begins with X
  std::vector<Node> pins{};
  std::string subcircuit{};
};

struct Circuit {
  std::vector<std::string> nodes{"0"};  ///< names; nodes[0] is ground
  std::vector<Node> outputs{};          ///< whose voltages are the answer, in order
  std::vector<Resistor> resistors{};
  std::vector<Capacitor> capacitors{};
  std::vector<Inductor> inductors{};
  std::vector<NShapedDevice> devices{};
  std::vector<CurrentSource> sources{};
  std::vector<Instance> instances{};
  /// Kinds of amplifiers; the one named "opamp" is what the library's sub-circuits are made of.
  std::vector<AmplifierModel> amplifiers{};
  double divider = 1e4;  ///< the resistors inside the library's sub-circuits [ohm], > 0
};

/// Adds a node and returns its index.
Node add_node(Circuit& circuit, std::string name);

/// Which nodes the sources hold at a voltage, by their index.
[[nodiscard]] std::vector<bool> held_nodes(const Circuit& circuit);

/// Names of the outputs' nodes, in their order.
[[nodiscard]] std::vector<std::string> output_names(const Circuit& circuit);

/// The model of that name, or nullptr.
[[nodiscard]] const AmplifierModel* amplifier(const Circuit& circuit, std::string_view name);

/// How the numbers of P f = b become physical: conductance = siemens * P_ij, node voltage =
/// volts * f_i, source current = siemens * volts * b_i.
struct Scale {
  double siemens = 1e-3;  ///< [S per unit of P], > 0
  double volts = 1.0;     ///< [V per unit of f], > 0
};

}  // namespace tactile_net
