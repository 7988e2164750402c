/// @file
/// Places in a half space, and how large readings are there.
#pragma once

#include <algorithm>
#include <cmath>

#include "tactile_net/elasticity/space/half_space.hpp"

namespace tactile_net {

struct Place {
  double x, y, z;
};

/// The largest reading of a kind; `load` is nothing for a point load, or a rectangle.
template <class... Load>
double largest_of(const Material& material, Traction component, const Place& p, QuantityKind kind,
                  const Load&... load) {
  double largest = 0.0;
  for (const Quantity q : skin_quantities)
    if (traits(q).kind == kind)
      largest = std::max(
          largest, std::abs(half_space_kernel(q, component, material, load..., p.x, p.y, p.z)));
  return largest;
}

}  // namespace tactile_net
