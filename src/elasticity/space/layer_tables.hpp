/// @file
/// What the base of a layer adds to a half space's readings: functions of the distance. Private.
#pragma once

#include "elasticity/space/layer_table.hpp"
#include "elasticity/space/radial_panels.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// Layer minus half space, with the thickness as the unit of length. Both transforms' difference
/// decays as exp(-k (2 - depth)); its Hankel transform
///
///     f(r) = 1/(2 pi) integral_0^inf k F(k) J_j(k r) dk
///
/// is taken by Gauss-Legendre panels that resolve J_j and the poles, and kept as f / r^j by
/// Chebyshev's polynomials in panels that grow with r: the layer's image of the load lies at least
/// 1 above the surface, so that f is smooth over such panels. Nothing is special at r = 0.
class LayerTables {
 public:
  /// @param material  checked, with a layer
  /// @param depth     in (0, 1], in units of the thickness
  LayerTables(const Material& material, double depth);

  /// The distance beyond which `far` is the whole of the layer's field: the poles of its transform
  /// lie at |Im k| >= 0.739.
  static constexpr double reach = 48.0;

  using Panels = RadialPanels<16>;

  /// f / r^j at the distance r in [0, reach).
  [[nodiscard]] Panels::At at(double r) const noexcept { return panels_.at(r); }

  /// f of the layer itself, half space included, for r >= reach.
  class Far {
   public:
    [[nodiscard]] double operator()(LayerTable table) const noexcept;

   private:
    friend class LayerTables;
    Far(const LayerTables& tables, double r) : tables_(tables), r_(r) {}
    const LayerTables& tables_;
    double r_;
  };
  [[nodiscard]] Far far(double r) const noexcept { return {*this, r}; }

 private:
  bool slips_;
  double nu_;
  double rest_;  // 1 - depth
  Panels panels_;
};

}  // namespace tactile_net
