/// @file
/// What an instance of a circuit is an instance of. Private.
#pragma once

#include <stdexcept>

#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/subcircuits.hpp"

namespace tactile_net {

/// The library's sub-circuit that the instance uses, or nullptr: it is one of the circuit's own
/// amplifiers, whose names go first.
///
/// @throw std::invalid_argument  it names neither, or has another number of pins
[[nodiscard]] inline const Subcircuit* subcircuit_of(const Circuit& circuit,
                                                     const Instance& instance) {
  const auto check_pins = [&](std::size_t pins) {
    if (instance.pins.size() != pins)
      throw std::invalid_argument("element " + instance.name + ": its pins do not fit '" +
                                  instance.subcircuit + "', which has " + std::to_string(pins));
  };
  if (const AmplifierModel* const model = amplifier(circuit, instance.subcircuit)) {
    check_pins(model->outputs == Outputs::single ? 3 : 4);
    return nullptr;
  }
  for (const Subcircuit& inside : subcircuits())
    if (inside.name == instance.subcircuit) {
      check_pins(inside.pins);
      return &inside;
    }
  throw std::invalid_argument("element " + instance.name + ": there is no sub-circuit '" +
                              instance.subcircuit +
                              "': it must be one of the library's (subcircuits.hpp) or an "
                              "amplifier of the circuit");
}

}  // namespace tactile_net
