/// @file
/// One build as a circuit of its own: every resistor and every op-amp with its own values.
#pragma once

#include <cstdint>
#include <span>

#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/network/resistor_errors.hpp"

namespace tactile_net {

/// What it was drawn from.
struct BuildParts {
  std::span<const double> printed{};  ///< on the resistors [S], in the flat circuit's order
  const ResistorErrors& resistors;    ///< as many
  /// How far each op-amp's bandwidth and second pole are off, alike, within +-, >= 0, < 1.
  double bandwidth = 0.0;
};

/// The draws are those of `LoadedNetwork::builds` and of a circuit's yield: offsets and bias
/// currents as `InputSpread` says, each op-amp its own, offsets at the build's temperature.
/// Complementary outputs are exact opposites. An op-amp k is of the model "opampk"; where its two
/// bias currents differ, sources Ib... make the difference.
///
/// @throw std::invalid_argument  another number of resistors
[[nodiscard]] Circuit drawn_circuit(const FlatCircuit& circuit, const BuildParts& parts,
                                    std::uint64_t seed, std::uint64_t build);

}  // namespace tactile_net
