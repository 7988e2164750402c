/// @file
/// What frames show before any is solved.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "arrays.hpp"
#include "tactile_net/lab/broken_taxels.hpp"

namespace tactile_net::python {

[[nodiscard]] inline lab::ReadingsCheck first_look(const AnyScene& scene, const Rows& readings) {
  std::size_t frame = 0;
  return lab::first_look(scene, [&](std::span<double> next) {
    if (frame == readings.shape(0)) return false;
    const std::span<const double> values = row(readings, frame++);
    std::copy(values.begin(), values.end(), next.begin());
    return true;
  });
}

}  // namespace tactile_net::python
