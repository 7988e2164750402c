/// @file
/// The discrete forward model, whatever way the convolution is done.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "numeric/require.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {

/// The readings of every channel, channels x count: the normal and the tangential field, each
/// through `add_block(channel, component, in, out)`, which adds one Toeplitz block times `in` to
/// `out`; channel is an index.
///
/// @throw std::invalid_argument  as `sampled_readings`
std::vector<double> superpose(const SensorArray& array, const TractionField& field,
                              auto add_block) {
  require_even(array, "the discrete sum");
  const std::size_t count = array.count;
  const std::string rule = "hold one value per taxel, " + std::to_string(count);
  require(field.normal.size() == count, "normal", rule, field.normal.size());
  require(field.tangential.empty() || field.tangential.size() == count, "tangential", rule,
          field.tangential.size());

  const std::size_t all = channel_count(array);
  std::vector<double> readings(all * count);
  for (std::size_t channel = 0; channel < all; ++channel) {
    const auto block = std::span(readings).subspan(channel * count, count);
    add_block(channel, Traction::normal, std::span(field.normal), block);
    if (!field.tangential.empty())
      add_block(channel, Traction::tangential_y, std::span(field.tangential), block);
  }
  return readings;
}

}  // namespace tactile_net
