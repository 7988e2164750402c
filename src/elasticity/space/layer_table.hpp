/// @file
/// What a layer's readings are made of: functions of the distance. Private.
#pragma once

#include <array>

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

}  // namespace tactile_net
