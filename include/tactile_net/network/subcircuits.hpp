/// @file
/// The sub-circuits of the folder `circuits/`, compiled in, so that every deck is complete.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace tactile_net {

/// Resistors of one value {r}, and amplifiers of the model "opamp".
struct Subcircuit {
  /// What it does to the voltages at its pins: all that the equations of a circuit ask.
  enum class Kind {
    floating_nic,  ///< pins a b oa ob: oa = 2 a - b, ob = 2 b - a
    grounded_nic,  ///< pins a out: out = 2 a
    inverter,      ///< pins in out: out = -in, and a resistor r from `in` to 0 V
  };
  Kind kind;
  std::string_view name;  ///< as in its .subckt line
  std::string_view text;  ///< the whole file `circuits/<name>.lib`, ends with a newline
  std::size_t pins = 0;   ///< of its .subckt line
};

/// Every sub-circuit, sorted by name.
[[nodiscard]] std::span<const Subcircuit> subcircuits() noexcept;

/// @throw std::invalid_argument  there is no sub-circuit of that name
[[nodiscard]] const Subcircuit& subcircuit(std::string_view name);

}  // namespace tactile_net
