/// @file
/// The ways to build a network, by name.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/conductances.hpp"

namespace tactile_net {

enum class Realization {
  ideal,  ///< resistors, negative ones included: the definition, for checking
  nic,    ///< op-amp negative impedance converters (thesis 5.2, item ii)
};

[[nodiscard]] std::string_view name(Realization realization) noexcept;
[[nodiscard]] std::optional<Realization> realization_named(std::string_view name) noexcept;

/// One resistor per branch and one to ground per node whose row sum is not zero.
///
/// Node i is named n0, n1, ...; branch R<i>_<j>; ground Rg<i>; source I<i>.
///
/// @param right_side  b, one value per node
/// @throw std::invalid_argument  sizes differ, a value is not finite, or the scale is not > 0
[[nodiscard]] Circuit ideal(const ConductanceNetwork& network, std::span<const double> right_side,
                            const Scale& scale);

/// As `ideal`, with every negative branch built from two op-amps (`floating_nic`) and every
/// negative ground conductance from one (`grounded_nic`). The '+' input of each op-amp is at the
/// network's node: with the inputs swapped the operating point is the same and the circuit is
/// unstable.
[[nodiscard]] Circuit nic(const ConductanceNetwork& network, std::span<const double> right_side,
                          const Scale& scale);

/// Calls the function of that name.
[[nodiscard]] Circuit realize(Realization realization, const ConductanceNetwork& network,
                              std::span<const double> right_side, const Scale& scale);

}  // namespace tactile_net
