/// @file
/// Noise that differs from taxel to taxel, beside the noise of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

struct TaxelNoise {
  /// Rms for every quantity that is read and every taxel [unit of the reading], >= 0.
  PerQuantity<std::vector<double>> rms;
  std::uint64_t seed = 1;
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const TaxelNoise& noise,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
