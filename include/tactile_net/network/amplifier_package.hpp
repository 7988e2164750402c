/// @file
/// The package that amplifiers are bought in, and what its pins are for.
///
///     soldered.amplifiers = part.packaged();  // opamp_part.hpp
///     board_of(soldered);                     // board.hpp
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/network/opamp.hpp"

namespace tactile_net {

/// Numbers of a package's pins, from 1. Of a signal one for each amplifier that the package holds;
/// of a supply all of them, to be joined. Pins that are not named stay open.
struct AmplifierPins {
  std::vector<int> in_plus{}, in_minus{};
  std::vector<int> out_plus{};   ///< of an op-amp of one output that one
  std::vector<int> out_minus{};  ///< empty: one output
  std::vector<int> supply_plus{}, supply_minus{};
  std::vector<int> common_mode{};  ///< takes the outputs' mean voltage; empty: has none
  std::vector<int> power_down{};   ///< works while it is high; empty: has none
  std::vector<int> exposed{};      ///< the pad below it, to be joined to ground; empty: has none

  /// How many amplifiers the package holds.
  [[nodiscard]] std::size_t amplifiers() const noexcept { return in_plus.size(); }
};

struct AmplifierPackage {
  std::string part{};        ///< by which it is ordered, for messages; empty: none is named
  std::string name{"SO-8"};  ///< as data sheets call it
  AmplifierPins pins{};

  /// An SO-8 with the usual pins of one op-amp, or of a fully differential amplifier: 1 -IN,
  /// 2 VOCM, 3 V+, 4 +OUT, 5 -OUT, 6 V-, 7 power-down, 8 +IN.
  [[nodiscard]] static AmplifierPackage usual(Outputs outputs);
};

}  // namespace tactile_net
