/// @file
/// Point loads summed over a part of a contact: the rule for whatever has no closed form. Private.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "skin/load_part.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// A kernel: readings at places (y, z) [m] from a unit point force.
using PointLoads = std::function<void(Quantity, Traction, std::span<const double> y,
                                      std::span<const double> z, std::span<double> readings)>;

/// The sum over rings s = constant around the contact's middle.
///
/// Along a ring equal angles converge exponentially, the faster the farther the taxel is; their
/// number is doubled until the mean stands still. Across the rings s = sin t, for a cone s = 1 /
/// cosh t, takes the profile's root, rim and apex away; panels of Gauss and Kronrod's rule (10 and
/// 21 points) shrink towards the ring below the taxel and are halved until both agree. One object
/// per thread.
class PartQuadrature {
 public:
  /// @param kernel  smooth over the distance `length` [m]
  PartQuadrature(PointLoads kernel, double length);

  /// Adds to `readings` those at the place (y, z) of each of the wanted quantities.
  ///
  /// @param tolerances  of each; each disagreement of rules stays below a share of it
  /// @return  false: the disagreements may exceed the tolerances, with as many point loads as are
  ///          allowed; nothing is added
  [[nodiscard]] bool add(const LoadPart& part, double y, double z, std::span<const Quantity> wanted,
                         std::span<const double> tolerances, std::span<double> readings);

 private:
  static constexpr std::size_t most = skin_quantities.size();
  using Values = std::array<double, most>;
  struct Taxel;

  void ring(const Taxel& taxel, double s, double share, Values& mean);
  void add_ring_points(const Taxel& taxel, double s, std::size_t level, Values& sum);
  void panel(const Taxel& taxel, double from, double to, int halvings, Values& sum);

  PointLoads kernel_;
  double length_;
  std::vector<std::vector<SurfaceVector>> angles_;  // of a level those that the ones before lack
  std::vector<double> y_, z_, values_;              // of a ring's points
  std::vector<SurfaceVector> twist_;
  std::size_t points_ = 0;  // of this taxel, so far
  bool converged_ = true;
};

}  // namespace tactile_net
