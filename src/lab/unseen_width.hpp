/// @file
/// Private. What falls between two taxels: the contact that no reading shows.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net::lab {

/// The width of the narrowest Hertz strip that changes a reading by more than its noise where it is
/// seen least: between the two live taxels farthest apart. Every narrower one, there, is in none.
///
/// @param channel_rms  noise of each channel, > 0
/// @param dead_taxels  indices < count
/// @param traction     the strip's largest normal traction [Pa], > 0
/// @return  [m]; absent: not even a strip as wide as the array is seen there, or there are not two
[[nodiscard]] std::optional<double> unseen_width(const SensorArray& array, const Material& material,
                                                 std::span<const double> channel_rms,
                                                 std::span<const std::size_t> dead_taxels,
                                                 double traction);

}  // namespace tactile_net::lab
