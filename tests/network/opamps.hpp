/// @file
/// The op-amp of most tests of networks.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "tactile_net/network/opamp.hpp"

namespace tactile_net {

inline constexpr double bandwidth = 1e7;  ///< [Hz]
inline constexpr double angular_bandwidth = 2.0 * std::numbers::pi * bandwidth;
inline constexpr OpAmp one_pole{.gain = 1e6, .bandwidth = bandwidth};

/// What `one_pole` may have besides, of a size that shows in an answer where it shows at rest.
inline constexpr std::array<std::pair<std::optional<double> OpAmp::*, double>, 13> further_keys{
    {{&OpAmp::second_pole, 2.5e7},
     {&OpAmp::offset, 1e-3},
     {&OpAmp::rail, 5.0},
     {&OpAmp::input_capacitance, 4e-12},
     {&OpAmp::differential_capacitance, 1e-12},
     {&OpAmp::load_capacitance, 2e-11},
     {&OpAmp::noise_voltage, 5e-9},
     {&OpAmp::noise_current, 1e-12},
     {&OpAmp::bias_current, 1e-7},
     {&OpAmp::common_mode_rejection, 1e5},
     {&OpAmp::slew, 1e7},
     {&OpAmp::output_resistance, 200.0},
     {&OpAmp::output_current, 0.05}}};

/// With the keys whose bits are set.
inline OpAmp opamp_with(unsigned set) {
  OpAmp opamp = one_pole;
  for (std::size_t k = 0; k < further_keys.size(); ++k)
    if ((set >> k & 1U) != 0) opamp.*further_keys[k].first = further_keys[k].second;
  if (opamp.noise_voltage && opamp.noise_current) opamp.noise_corner = 1e3;
  return opamp;
}

}  // namespace tactile_net
