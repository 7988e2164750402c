/// @file
/// Everything that a traction on a skin as it is, half space or layer, causes at one depth.
#pragma once

#include <memory>
#include <span>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/elasticity/space/half_space.hpp"

namespace tactile_net {

class LayerTables;

/// Refuses readings that have no value.
/// @throw std::invalid_argument  a displacement along the surface under a tangential load in a
///                               layer on a frictionless base: nothing holds the layer, which
///                               slides without end
void check_quantity(Quantity quantity, Traction component, const Material& material);

/// Readings at one depth from point loads and rectangles, as functions of the place.
///
/// On a half space they are `half_space_kernel`. In a layer they are that plus what the base adds:
/// fifteen functions of the distance r alone, interpolated, times an angle. Beyond 48 layers from
/// the load what is left of them in closed form: 0 on a bonded base; on a frictionless one, which
/// holds no drag, that of a thin plate, falling as 1/r. A copy shares the tables.
///
/// Readings are within `error_bound` of the true ones, and of even or odd parity to the bit; those
/// that `check_quantity` refuses are NaN. Places are finite; lengths may be of any size.
class SkinKernel {
 public:
  /// O(1) on a half space; in a layer some milliseconds, for all quantities together, and 0.1 s for
  /// what all depths share, once in a process.
  ///
  /// @throw std::invalid_argument  the material is out of range; depth is not > 0, or below the
  ///                               base
  SkinKernel(const Material& material, double depth);

  /// The reading at (y, z) [m] from a unit point force [Pa/N for stress, 1/N for strain, m/N].
  [[nodiscard]] double operator()(Quantity quantity, Traction component, double y,
                                  double z) const noexcept;

  /// The reading at (y, z) [m] from the middle of a rectangle that carries a uniform traction of
  /// 1 Pa. In a layer up to 64 times the cost of a point load, more for each layer that the
  /// rectangle is wide.
  [[nodiscard]] double operator()(Quantity quantity, Traction component, const Rectangle& load,
                                  double y, double z) const noexcept;

  /// Readings from a unit point force, and from a rectangle under 1 Pa, at many places; `y`, `z`
  /// and `readings` have one number each.
  void operator()(Quantity quantity, Traction component, std::span<const double> y,
                  std::span<const double> z, std::span<double> readings) const noexcept;
  void operator()(Quantity quantity, Traction component, const Rectangle& load,
                  std::span<const double> y, std::span<const double> z,
                  std::span<double> readings) const noexcept;

  /// What the base adds to a half space's readings from unit point forces, zeros on a half space.
  /// It changes with the place over lengths of 2 h - depth, h = thickness, and not of the depth.
  void base_part(Quantity quantity, Traction component, std::span<const double> y,
                 std::span<const double> z, std::span<double> readings) const noexcept;

  /// The largest error of a point load's reading: 1e-13 of 3 / (2 pi depth^2) for stresses, of
  /// (1 + nu) / E times that for strains, of 3 (1 + nu) / (2 pi E depth) for displacements, which
  /// is about what a half space reads on the load's axis. For a rectangle's reading: this times its
  /// area, or times depth^2 where that is less.
  [[nodiscard]] double error_bound(Quantity quantity) const noexcept;

 private:
  struct LayerPart {
    double reading;
    bool is_whole;  // half space included
  };
  [[nodiscard]] LayerPart layer_part(Quantity quantity, Traction component, double y,
                                     double z) const noexcept;
  [[nodiscard]] double with_base(Quantity quantity, Traction component, double half_space, double y,
                                 double z) const noexcept;
  [[nodiscard]] double added(Quantity quantity, Traction component, double y,
                             double z) const noexcept;
  [[nodiscard]] double added(Quantity quantity, Traction component, const Rectangle& load, double y,
                             double z) const noexcept;

  Material material_;
  double depth_;
  std::shared_ptr<const LayerTables> tables_{};  // absent: half space
};

}  // namespace tactile_net
