/// @file
/// What real op-amps do to a circuit's answer at rest.
#pragma once

#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {

/// Errors of a kind that every op-amp has its own of, over the 2-norm of the answer, to first
/// order.
struct InputErrors {
  double alike = 0.0;        ///< every op-amp's as large, of one sign: as a deck has it
  double either_sign = 0.0;  ///< as large, signs by chance: root mean square
};

/// Each relative to the answer of the circuit without it; 0: the op-amps have none.
struct StaticErrors {
  InputErrors offset{};
  InputErrors bias_current{};
  double common_mode = 0.0;
  double output_resistance = 0.0;
};

/// From the linear equations at rest: one sparse decomposition, and one more for each of the last
/// two.
///
/// @throw std::invalid_argument  as `operating_voltages`
/// @throw std::domain_error      as `operating_voltages`, or the circuit rests at 0
[[nodiscard]] StaticErrors static_errors(const FlatCircuit& circuit);

}  // namespace tactile_net
