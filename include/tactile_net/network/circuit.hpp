/// @file
/// A circuit as plain data: what a realisation builds and the deck writer prints.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tactile_net {

/// Index into `Circuit::nodes`; 0 is ground.
using Node = std::size_t;

struct Resistor {
  std::string name{};  ///< begins with R
  Node from = 0;
  Node to = 0;
  double siemens = 0.0;  ///< not 0; negative: a negative resistor
};

struct CurrentSource {
  std::string name{};  ///< begins with I
  Node into = 0;       ///< the current flows from ground into this node
  double ampere = 0.0;
};

/// One use of a sub-circuit from `subcircuits.hpp`.
struct Instance {
  std::string name{};  ///< begins with X
  std::vector<Node> pins{};
  std::string subcircuit{};
};

struct Circuit {
  std::vector<std::string> nodes{"0"};  ///< names; nodes[0] is ground
  std::vector<Node> outputs{};          ///< whose voltages are the answer, in order
  std::vector<Resistor> resistors{};
  std::vector<CurrentSource> sources{};
  std::vector<Instance> instances{};
};

/// Adds a node and returns its index.
Node add_node(Circuit& circuit, std::string name);

/// What the circuit is made of, sub-circuits' contents included.
struct ElementCounts {
  std::size_t resistors = 0;           ///< all, negative ones included
  std::size_t negative_resistors = 0;  ///< ideal ones, of negative value
  std::size_t opamps = 0;
  std::size_t inductors = 0;
  std::size_t capacitors = 0;
  std::size_t sources = 0;
};

/// @throw std::invalid_argument  an instance names an unknown sub-circuit
[[nodiscard]] ElementCounts count_elements(const Circuit& circuit);

/// How the numbers of P f = b become physical: conductance = siemens * P_ij, node voltage =
/// volts * f_i, source current = siemens * volts * b_i.
struct Scale {
  double siemens = 1e-3;  ///< [S per unit of P], > 0
  double volts = 1.0;     ///< [V per unit of f], > 0
};

}  // namespace tactile_net
