/// @file
/// What the base of a layer adds to a half space's readings: functions of the distance. Private.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// The functions f(r) whose products with an angle make a field; the number behind is j, the order
/// of that angle, and of the Bessel function in the transform. Displacements times 2 G.
///
///     under p      xx = x,  xr = radial cos a,  (yy + zz) / 2 = trace,  (yy - zz) / 2 + i yz =
///                  deviator exp(2 i a),  u_x = displacement_x,  u_r = displacement_radial
///     under q_y    xx = x cos a,  xy + i xz = mean + turning exp(2 i a),
///                  (yy + zz) / 2 = trace cos a,  (yy - zz) / 2 + i yz = deviator exp(i a) +
///                  deviator_turning exp(3 i a),  u alike
enum class LayerTable {
  normal_x,                        // 0
  normal_radial,                   // 1
  normal_trace,                    // 0
  normal_deviator,                 // 2
  normal_displacement_x,           // 0
  normal_displacement_radial,      // 1
  tangential_x,                    // 1
  tangential_mean,                 // 0
  tangential_turning,              // 2
  tangential_trace,                // 1
  tangential_deviator,             // 1
  tangential_deviator_turning,     // 3
  tangential_displacement_x,       // 1
  tangential_displacement_mean,    // 0
  tangential_displacement_turning  // 2
};

inline constexpr std::array<int, 15> layer_table_orders = {0, 1, 0, 2, 0, 1, 1, 0,
                                                           2, 1, 1, 3, 1, 0, 2};
using LayerFunctionValues = std::array<double, layer_table_orders.size()>;

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

  /// Chebyshev's polynomials at one distance, for any of the tables.
  class At {
   public:
    /// f / r^j.
    [[nodiscard]] double operator()(LayerTable table) const noexcept;

    static constexpr std::size_t count = 16;

   private:
    friend class LayerTables;
    At() = default;
    const double* coefficients_ = nullptr;
    std::array<double, count> polynomials_{};
  };

  /// @param r  in [0, reach)
  [[nodiscard]] At at(double r) const noexcept;

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
  double rest_;                       // 1 - depth
  std::vector<double> coefficients_;  // panel by panel, table by table
};

}  // namespace tactile_net
