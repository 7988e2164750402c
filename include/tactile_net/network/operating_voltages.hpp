/// @file
/// A circuit at rest, with what finite gain and offsets do to it.
#pragma once

#include <vector>

#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {

/// The outputs at rest with amplifiers of finite gain (1e6 where a model gives none), their
/// offsets, bias currents, output resistances and finite common-mode rejections [V], by a sparse
/// elimination: for circuits of any size, and without bandwidths.
///
/// @throw std::invalid_argument  the circuit has an inductor
/// @throw std::domain_error      it has no unique operating point
[[nodiscard]] std::vector<double> operating_voltages(const FlatCircuit& circuit);

/// What the op-amps' outputs that give off current give off together at rest [A]: their supply has
/// it beside what they take themselves.
///
/// @throw std::invalid_argument, std::domain_error  as `operating_voltages`
[[nodiscard]] double sourced_current(const FlatCircuit& circuit);

}  // namespace tactile_net
