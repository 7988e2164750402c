/// @file
/// A circuit whose sub-circuits are opened: nothing but two-terminal parts and amplifiers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/network/circuit.hpp"

namespace tactile_net {

/// Made once from a circuit and passed on: opening thousands of converters takes longer than most
/// of what is then asked of them.
///
/// A function that takes a `FlatCircuit` can be given a `Circuit`, which is then flattened for that
/// call alone.
class FlatCircuit {
 public:
  /// The circuit is copied; it need not outlive the object.
  ///
  /// @throw std::invalid_argument  an instance names neither an amplifier of the circuit nor a
  ///                               sub-circuit of the library, or has the wrong number of pins
  FlatCircuit(const Circuit& circuit);  // NOLINT(google-explicit-constructor): see above

  /// The same circuit, every instance an amplifier. What stood inside a sub-circuit has its place
  /// in the name, "R1.Xf0_1", and follows the circuit's own parts, in the order of the instances.
  [[nodiscard]] const Circuit& circuit() const noexcept { return circuit_; }

  /// One per instance, in the same order.
  struct Amplifier {
    Node plus = 0;
    Node minus = 0;
    Node out = 0;
    Node inverse = 0;       ///< -out; 0: there is none
    std::size_t model = 0;  ///< index into `circuit().amplifiers`
    bool inside = false;    ///< it stood in a sub-circuit
  };
  [[nodiscard]] std::span<const Amplifier> amplifiers() const noexcept { return amplifiers_; }

  [[nodiscard]] const OpAmp& opamp(const Amplifier& amplifier) const {
    return circuit_.amplifiers[amplifier.model].opamp;
  }

  /// Whether converters or inverters of the library stood in the circuit.
  [[nodiscard]] bool had_subcircuits() const noexcept { return had_subcircuits_; }

 private:
  Circuit circuit_;
  std::vector<Amplifier> amplifiers_;
  bool had_subcircuits_ = false;
};

/// Every resistor [ohm], those inside sub-circuits after the circuit's own; negative: a negative
/// resistor.
[[nodiscard]] std::vector<double> resistances(const FlatCircuit& circuit);

/// What a circuit is made of, sub-circuits' contents included.
struct ElementCounts {
  std::size_t resistors = 0;           ///< all, negative ones included
  std::size_t negative_resistors = 0;  ///< ideal ones, of negative value
  std::size_t opamps = 0;              ///< one with complementary outputs counts as one
  std::size_t inductors = 0;
  std::size_t capacitors = 0;
  std::size_t devices = 0;  ///< N-shaped
  std::size_t sources = 0;
};

[[nodiscard]] ElementCounts count_elements(const FlatCircuit& circuit);

}  // namespace tactile_net
