/// @file
/// The sums over spherical harmonics that a layer on a ball reads by. Private.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "elasticity/space/ball_modes.hpp"
#include "elasticity/space/layer_table.hpp"

namespace tactile_net {

/// Functions of a degree and of the angle g from the load that the tables are summed of: Legendre's
/// polynomial and its first two derivatives by the cosine, each over its value at 0, and what is
/// made of them and the third.
enum class BallShape { p0, p1, p2, mean, turning, deviator, deviator_turning };
inline constexpr std::size_t ball_shape_count = 7;

/// Of each table.
inline constexpr std::array<BallShape, layer_table_orders.size()> ball_shapes = {
    BallShape::p0,      BallShape::p1,   BallShape::p0,       BallShape::p2,
    BallShape::p0,      BallShape::p1,   BallShape::p1,       BallShape::mean,
    BallShape::turning, BallShape::p1,   BallShape::deviator, BallShape::deviator_turning,
    BallShape::p1,      BallShape::mean, BallShape::turning};

/// By how much each table grows with a degree: the thickness and a unit point force as units,
/// displacements times 2 G.
///
/// @param curvature  thickness over radius
/// @param depth      over the thickness
template <class Number>
std::array<Number, layer_table_orders.size()> ball_amplitudes(const BallModeOf<Number>& mode,
                                                              std::size_t degree,
                                                              const Number& curvature,
                                                              const Number& depth) noexcept {
  const auto n = static_cast<double>(degree);
  const double c = n * (n + 1.0);
  const double out = std::copysign(1.0, plain(curvature));
  const Number stress = (2.0 * n + 1.0) / (4.0 * std::numbers::pi) * curvature * curvature;
  const Number displacement = 2.0 * (2.0 * n + 1.0) / (4.0 * std::numbers::pi) * (out * curvature);
  const Number per_place = 1.0 / (1.0 - curvature * depth);
  const auto& [p, q, twist, twist_shear] = mode;
  return {stress * p.stress,
          out * stress * p.shear * 0.5 * c,
          stress * p.mean_along,
          stress * p.along * per_place * c * (c - 2.0) / 8.0,
          out * displacement * p.radial,
          displacement * p.along * 0.5 * c,
          -out * stress * q.stress * 0.5,
          stress * (q.shear + twist_shear) * 0.5,
          -stress * (q.shear - twist_shear) * 0.25,
          -out * stress * q.mean_along * 0.5,
          out * stress * (q.along + twist) * per_place * (c - 2.0) * 0.25,
          -out * stress * (q.along - twist) * per_place * (c - 2.0) / 16.0,
          -displacement * q.radial * 0.5,
          out * displacement * (q.along + twist) * 0.5,
          -out * displacement * (q.along - twist) * 0.25};
}

/// Arcs from the load, and the shapes there degree by degree. Polynomials go from one degree to the
/// next by differences: by 1 - cos, which is known to its last digit, they lose none near the load.
template <std::size_t count>
class ArcShapes {
 public:
  using Values = std::array<double, count>;

  /// @param arcs       [any length]
  /// @param curvature  one over the radius
  ArcShapes(const Values& arcs, double curvature) noexcept : arc_(arcs) {
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = arcs[i] * std::abs(curvature);
      const double half_sine = std::sin(0.5 * angle);
      sine_[i] = std::sin(angle);
      sine_squared_[i] = sine_[i] * sine_[i];
      versine_[i] = 2.0 * half_sine * half_sine;
    }
    for (Values& values : legendre_) values.fill(1.0);
  }

  /// The shapes of the next degree, from 0 on.
  void take(std::array<Values, ball_shape_count>& shapes) noexcept {
    const auto n = static_cast<double>(degree_);
    const double c = n * (n + 1.0);
    const auto& [p0, p1, p2, p3] = legendre_;
    auto& [shape0, shape1, shape2, mean, turning, deviator, deviator_turning] = shapes;
    for (std::size_t i = 0; i < count; ++i) {
      const double v = versine_[i];
      const double ss = sine_squared_[i];
      shape0[i] = p0[i];
      shape1[i] = p1[i];
      shape2[i] = p2[i];
      mean[i] = p0[i] + 0.5 * v * p1[i];
      turning[i] = v * p1[i] + 0.25 * (c - 2.0) * ss * p2[i];
      deviator[i] = p1[i] + 0.5 * v * p2[i];
      deviator_turning[i] = (c - 6.0) / 6.0 * ss * p3[i] + 2.0 * v * p2[i];
    }
    for (std::size_t k = 0; k <= std::min<std::size_t>(3, degree_); ++k) {
      const auto order = static_cast<double>(k);
      const double kept = (n - order) / (n + order + 1.0);
      const double turned = (2.0 * n + 1.0) / (n + order + 1.0);
      Values& p = legendre_[k];
      Values& step = step_[k];
      for (std::size_t i = 0; i < count; ++i) {
        step[i] = kept * step[i] - turned * versine_[i] * p[i];
        p[i] += step[i];
      }
    }
    ++degree_;
  }

  /// What a table's sum is multiplied by at arc i: then it is f / r^j.
  [[nodiscard]] double factor(LayerTable table, std::size_t i) const noexcept {
    const double per_arc = 1.0 / arc_[i];
    const double sine = sine_[i] * per_arc;
    switch (ball_shapes[static_cast<std::size_t>(table)]) {
      case BallShape::p0:
      case BallShape::mean:
        return 1.0;
      case BallShape::p1:
      case BallShape::deviator:
        return sine;
      case BallShape::p2:
        return sine * sine;
      case BallShape::turning:
        return per_arc * per_arc;
      case BallShape::deviator_turning:
        return sine * per_arc * per_arc;
    }
    return 1.0;
  }

 private:
  Values arc_{}, sine_{}, versine_{}, sine_squared_{};
  std::array<Values, 4> legendre_{}, step_{};
  std::size_t degree_ = 0;
};

/// Sums at radii of fewer thicknesses are taken as they are; larger radii, of which the field is a
/// power series in the curvature, are interpolated.
inline constexpr double farthest_ball = 320.0;
/// Thicknesses of arc beyond which less is left than 1e-15 of the largest.
inline constexpr double ball_reach = 48.0;

/// The curvatures, thickness over radius, whose sums times these weights are those of a curvature:
/// itself, or those of Lagrange's polynomials through radii of 20 to 50 thicknesses, of balls and
/// holes.
[[nodiscard]] inline std::vector<std::pair<double, double>> summed_curvatures(double curvature) {
  if (std::abs(curvature) * farthest_ball >= 1.0) return {{curvature, 1.0}};
  std::vector<std::pair<double, double>> nodes;
  for (std::size_t i = 0; i < 5; ++i) {
    const double node = 0.05 * (1.0 - 0.15 * static_cast<double>(i));
    nodes.emplace_back(node, 1.0);
    nodes.emplace_back(-node, 1.0);
  }
  for (auto& [node, weight] : nodes)
    for (const auto& [other, unused] : nodes)
      if (other != node) weight *= (curvature - other) / (node - other);
  return nodes;
}

}  // namespace tactile_net
