/// @file
/// The discrete forward model, whatever way the convolution is done.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "elasticity/require.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {

/// The readings of every channel, channels x count: the normal and the tangential field, each
/// through `add_block(kernel, in, out)`, which adds one Toeplitz block times `in` to `out`.
///
/// @throw std::invalid_argument  as `sampled_readings`
std::vector<double> superpose(const SensorArray& array, const Material& material,
                              const TractionField& field, auto add_block) {
  check(array);
  check(material);
  const std::size_t count = array.count;
  const std::string rule = "hold one value per taxel, " + std::to_string(count);
  require(field.normal.size() == count, "normal", rule, field.normal.size());
  require(field.tangential.empty() || field.tangential.size() == count, "tangential", rule,
          field.tangential.size());

  const std::vector<Channel> all = channels(array);
  std::vector<double> readings(all.size() * count);
  auto out = std::span(readings);
  for (const Channel& channel : all) {
    const auto block = out.first(count);
    out = out.subspan(count);
    add_block(sampled_kernel(channel, Traction::normal, material, count, array.pitch),
              std::span(field.normal), block);
    if (!field.tangential.empty())
      add_block(sampled_kernel(channel, Traction::tangential, material, count, array.pitch),
                std::span(field.tangential), block);
  }
  return readings;
}

}  // namespace tactile_net
