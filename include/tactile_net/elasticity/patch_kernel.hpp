/// @file
/// What patches of load cause below the surface, in closed form: strips whose place, width and
/// force change at every moment, as a rigid-body simulator's contacts do.
///
/// On a half plane a patch's reading follows from the Cauchy transform of its tractions at
/// z = u + i depth, u from the patch's centre, a its half width (Muskhelishvili):
///
///     hertz   2 F / (z + w),  w^2 = z^2 - a^2;                      its derivative is -C / w
///     linear  (p + q z) log((z + a) / (z - a)) - 2 a q,  p = F / 2a, q = 3 M / 2 a^3.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// A strip of the surface under a load of a simple form. Both tractions have that form, except that
/// under a linear load the tangential one is the same everywhere.
struct LoadPatch {
  enum class Form {
    hertz,   ///< 2 F / (pi a^2) sqrt(a^2 - t^2): a round object
    linear,  ///< F / 2a + 3 M t / 2a^3: a flat one; it pulls nowhere if |M| <= F a / 3
  };
  Form form = Form::hertz;
  double center = 0.0;      ///< [m]
  double half_width = 1.0;  ///< a [m], > 0
  double normal = 0.0;      ///< F [N/m]
  double tangential = 0.0;  ///< [N/m]
  double moment = 0.0;      ///< M, of the normal tractions about the centre [N]; linear only
};

class LayerCorrection;

/// The readings of several quantities at one depth, of any patch.
///
/// On a half plane within 1e-13 of the patch's largest reading, as long as the patch is wider than
/// a thousandth of the depth; in a layer within 1e-11 of the largest that the force could cause.
class PatchKernel {
 public:
  /// O(1) on a half plane; in a layer as a `PadKernel` for each quantity and component.
  ///
  /// @throw std::invalid_argument  the material is out of range; depth is not > 0, or below the
  ///                               base; a line array does not read one of the quantities
  PatchKernel(std::span<const Quantity> reads, const Material& material, double depth);
  ~PatchKernel();
  PatchKernel(PatchKernel&& other) noexcept;

  /// Adds `weight` times what the patch causes at the place y [m] to `readings`, one for each
  /// quantity. No allocation. A half plane takes a complex root or logarithm, a flat patch far away
  /// ten line loads; a layer besides as many interpolations as it takes to follow the load, ten for
  /// a patch as wide as the layer is thick.
  void add(const LoadPatch& patch, double y, double weight,
           std::span<double> readings) const noexcept;

 private:
  struct Reading;
  std::vector<Reading> reads_;
  Material material_;
  double depth_;
};

}  // namespace tactile_net
