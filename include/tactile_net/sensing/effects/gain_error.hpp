/// @file
/// Taxels that are more, or less, sensitive than they were taken for.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// reading -> (1 + e) reading. Either `values` or `rms`.
struct GainError {
  std::vector<double> values{};  ///< e of every taxel, the same for all its quantities
  double rms = 0.0;              ///< rms of e, drawn for each reading from a Gaussian, >= 0
  std::uint64_t seed = 1;
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const GainError& error,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
