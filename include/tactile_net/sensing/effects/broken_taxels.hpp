/// @file
/// Taxels that do not answer to the load any more.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// Taxels that read the same for ever. The methods are not told.
struct StuckTaxels {
  std::vector<std::size_t> indices{};         ///< < count, none twice
  PerQuantity<std::vector<double>> values{};  ///< one per index [unit of the reading]
};
[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const StuckTaxels& stuck,
                                                        const SignalLayout& sensor);

/// Sets the readings of dead taxels to zero.
/// @pre  readings of one channel, and indices below their count
void kill(std::span<double> readings, std::span<const std::size_t> dead_taxels) noexcept;

/// Taxels that read zero for ever, and that the methods leave out.
struct DeadTaxels {
  std::vector<std::size_t> indices{};  ///< < count
};
[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const DeadTaxels& dead,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
