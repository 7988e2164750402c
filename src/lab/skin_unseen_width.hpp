/// @file
/// Private. What falls between the taxels of a skin: the contact that no reading shows.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net::lab {

/// A place on a skin [m].
struct SkinPlace {
  double y = 0.0;
  double z = 0.0;
};

/// The place among the taxels that is farthest from any live one; of equal ones that nearest to
/// their middle. Absent: there are not two live taxels.
///
/// @param dead_taxels  indices < taxel_count
[[nodiscard]] std::optional<SkinPlace> widest_hole(const SkinArray& skin,
                                                   std::span<const std::size_t> dead_taxels);

/// As `unseen_width` of a line: the width of the narrowest Hertz circle that changes a reading by
/// more than its noise where it is seen least: about the widest hole. Every narrower one, there, is
/// in none.
///
/// @param channel_rms  noise of each channel, > 0
/// @param dead_taxels  indices < taxel_count
/// @param traction     the circle's largest normal traction [Pa], > 0
/// @return  [m]; absent: not even a circle as wide as the skin is seen there, or there are not two
///          live taxels
[[nodiscard]] std::optional<double> skin_unseen_width(const SkinArray& skin,
                                                      const Material& material,
                                                      std::span<const double> channel_rms,
                                                      std::span<const std::size_t> dead_taxels,
                                                      double traction);

}  // namespace tactile_net::lab
