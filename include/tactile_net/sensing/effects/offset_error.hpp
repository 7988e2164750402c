/// @file
/// Taxels that do not read zero when nothing touches them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// reading -> reading + e. Either `values` or `rms`, of every quantity that is read
/// [unit of the reading].
struct OffsetError {
  PerQuantity<std::vector<double>> values{};  ///< e of every taxel
  PerQuantity<double> rms{};                  ///< rms of e, drawn from a Gaussian, >= 0
  std::uint64_t seed = 1;
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const OffsetError& error,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
