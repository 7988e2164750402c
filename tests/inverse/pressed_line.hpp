/// @file
/// A line of coarse taxels under a mixture of loads, and what it reads of a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/inverse/pads.hpp"

namespace tactile_net {

/// @param unknowns  1, or 2 that shear is read for
inline SensorArray array_of(std::size_t unknowns) {
  SensorArray array = coarse_array;
  if (unknowns == 2) array.reads = {Quantity::stress_x, Quantity::shear_xy};
  return array;
}

inline LinearProblem line_of(std::size_t unknowns) {
  return make_problem(array_of(unknowns), pad,
                      {.unknowns = unknowns,
                       .smoothing_length = 1.0,
                       .surface = {.basis = SurfaceBasis::hats, .spacing = 0.5}});
}

/// Dragged where there are two unknowns, with noise of rms `pad_noise`.
inline std::vector<double> pressed(std::size_t unknowns, double centre = 1.3,
                                   std::uint64_t seed = 1) {
  const std::vector<Contact> contacts = {
      RigidContact{.center = centre, .half_width = 1.0, .friction = unknowns == 2 ? 0.3 : 0.0}};
  std::vector<double> readings = exact_readings(array_of(unknowns), pad, contacts);
  add_noise(readings, pad_noise, seed, 0);
  return readings;
}

}  // namespace tactile_net
