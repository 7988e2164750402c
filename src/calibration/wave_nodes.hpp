/// @file
/// Where integrals over waves are summed: Gauss and Legendre's rule of 20 points, panel by panel.
/// Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "numeric/gauss_rule.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// k depth up to which integrals run: exp(-k depth) is some 1e-15 there, times the k depth of the
/// amplitudes.
inline constexpr double largest_decay = 36.0;

/// Calls of(x, weight) for each point of the panel from `from`.
template <class Of>
void each_point(double from, double width, const Of& of) {
  const GaussRule rule = gauss_rule<20>();
  for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
    for (const double sign : {-1.0, 1.0})
      of(from + 0.5 * width * (1.0 + sign * rule.abscissa[i]), 0.5 * width * rule.weights[i]);
}

/// Nodes in k for readings at one depth; weights are over pi. Panels are some 26 radians of the
/// fastest wave wide, those near 0 no wider than a layer asks for: its poles are 0.7 / h away.
struct WaveNodes {
  /// @param farthest     along the surface, from any point of a contact to any reading
  /// @param most_panels  a fit that has gone astray may ask for more; it is not to take the memory
  WaveNodes(double depth, double farthest, const Material& material, double most_panels) {
    const double end = largest_decay / depth;
    const double wide = end / std::clamp(std::ceil(end * farthest / 26.0), 5.0, most_panels);
    const double h = material.layer ? material.layer->thickness : 0.0;
    for (double from = 0.0; from < end * (1.0 - 1e-9);) {
      const double width = from * h < 15.0 && h > 0.0 ? std::min(wide, 2.5 / h) : wide;
      each_point(from, width, [this](double at, double share) {
        k.push_back(at);
        weight.push_back(share / std::numbers::pi);
      });
      from += width;
    }
  }
  std::vector<double> k{}, weight{};
};

}  // namespace tactile_net
