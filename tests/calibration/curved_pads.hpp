/// @file
/// Curved pads, and what they read under round indenters by sums of point loads: the calibration's
/// readings are sums over spherical harmonics, which share nothing with them but the kernel.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "calibration/wave_nodes.hpp"
#include "tactile_net/calibration/press_model.hpp"
#include "tactile_net/elasticity/space/ball_kernel.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {

/// Where a sensor stands: its axes in those of the world, row after row, and its origin.
struct Stand {
  std::array<SpaceVector, 3> axes{SpaceVector{1, 0, 0}, SpaceVector{0, 1, 0}, SpaceVector{0, 0, 1}};
  SpaceVector origin{};

  [[nodiscard]] SpaceVector turned(const SpaceVector& v) const {
    return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
  }
  [[nodiscard]] SpaceVector moved(const SpaceVector& v) const {
    return combined(1.0, turned(v), 1.0, origin);
  }
};

/// About an axis that is none of the sensor's.
inline Stand turned_stand() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-0.4), t = std::sin(-0.4);
  return {{SpaceVector{c, -s * d, s * t}, SpaceVector{s, c * d, -c * t}, SpaceVector{0.0, t, d}},
          {3e-3, -2e-3, 5e-3}};
}

struct DomeOptions {
  std::size_t side = 5;   ///< taxels along each side
  double radius = 20e-3;  ///< of the surface; < 0: of a hole
  double pitch = 2e-3;    ///< of arc
  double depth = 1.5e-3;
  std::vector<Quantity> reads{Quantity::stress_x};
  ReadingAxes axes = ReadingAxes::local;
  Stand stand{};
};

/// Taxels evenly over a dome, or over the ground of a hole, around the sensor's z.
inline SkinArray dome(const DomeOptions& options) {
  std::vector<CurvedTaxel> taxels;
  const double half = 0.5 * static_cast<double>(options.side - 1);
  for (std::size_t i = 0; i < options.side; ++i)
    for (std::size_t k = 0; k < options.side; ++k) {
      const double y = options.pitch * (static_cast<double>(i) - half);
      const double z = options.pitch * (static_cast<double>(k) - half);
      const double arc = std::hypot(y, z);
      const double angle = arc / options.radius;
      const double share = arc > 0.0 ? std::sin(angle) / arc : 0.0;
      const SpaceVector normal{share * z, share * y, std::cos(angle)};  // the chart's z is x
      const double lift = options.radius * -2.0 * std::pow(std::sin(0.5 * angle), 2);
      const SpaceVector above{options.radius * normal[0], options.radius * normal[1], lift};
      const SpaceVector place = combined(1.0, above, -options.depth, normal);
      taxels.push_back({.name = {},
                        .place = options.stand.moved(place),
                        .normal = options.stand.turned(normal),
                        .depth = options.depth,
                        .reads = options.reads});
    }
  return curved_skin(std::move(taxels), {.shape = SurfaceShape::sphere,
                                         .radius = options.radius,
                                         .reference = options.stand.turned({0, 1, 0}),
                                         .axes = options.axes});
}

/// The place at the end of an arc from a place, its frame brought along.
inline SurfaceFrame carried(const SurfaceFrame& from, double angle, double direction) {
  const double c = std::cos(direction), s = std::sin(direction);
  const SpaceVector ahead = combined(c, from[1], s, from[2]);
  const SpaceVector aside = combined(-s, from[1], c, from[2]);
  const SpaceVector x = combined(std::cos(angle), from[0], std::sin(angle), ahead);
  const SpaceVector along = combined(std::cos(angle), ahead, -std::sin(angle), from[0]);
  return {x, combined(c, along, -s, aside), combined(s, along, c, aside)};
}

/// Readings of a skin on a sphere under one indenter, by point loads on rings of equal chord.
inline std::vector<double> summed_readings(const SkinArray& skin, const Material& pad,
                                           const PressState& press, std::size_t angles = 48) {
  const CurvedSkin& curved = *skin.curved;
  const double radius = 1.0 / curved.surface.curvature();
  const BallKernel kernel(pad, radius, skin.taxels.front().depth);
  const std::vector<Site> where = sites(skin);
  std::vector<double> all(where.size());
  const SurfaceFrame middle = curved.surface.at(press.center, press.center_z).frame;
  const double force = std::exp(press.log_force);
  const auto ring = [&](double chord, double weight) {
    const double angle = 2.0 * std::asin(0.5 * chord / std::abs(radius));
    for (std::size_t i = 0; i < angles; ++i) {
      // Inward normals of a ball turn with the arc, those of a hole against it.
      const SurfaceFrame load = carried(
          middle, radius > 0.0 ? -angle : angle,
          2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(angles) +
              (radius > 0.0 ? std::numbers::pi : 0.0));
      const double share = force * weight / static_cast<double>(angles);
      for (std::size_t j = 0; j < where.size(); ++j) {
        const SurfaceFrame& taxel = curved.above[where[j].taxel].frame;
        const BallPlace place = ball_place(load, taxel, radius);
        const auto add = [&](Quantity quantity, double of) {
          const auto [p, qy, qz] = kernel(quantity, place);
          all[j] += of * share * (p + press.friction * qy + press.friction_z * qz);
        };
        const QuantityTraits& kind = traits(where[j].quantity);
        if (curved.axes == ReadingAxes::local || kind.kind != QuantityKind::displacement) {
          add(where[j].quantity, 1.0);
        } else {
          const auto along = static_cast<std::size_t>(kind.first);
          add(Quantity::displacement_x, taxel[0][along]);
          add(Quantity::displacement_y, taxel[1][along]);
          add(Quantity::displacement_z, taxel[2][along]);
        }
      }
    }
  };
  // p dA over F: 3 u^2 du of a ball with u^2 = 1 - s^2, du of a punch; a cone is punches of all
  // radii t with weights 2 t dt.
  const double a = std::exp(press.log_half_width);
  each_point(0.0, 1.0, [&](double u, double weight) {
    const double s = std::sqrt(1.0 - u * u);
    if (press.disc == DiscProfile::sphere) ring(a * s, 3.0 * u * u * weight);
    if (press.disc == DiscProfile::punch) ring(a * s, weight);
    if (press.disc == DiscProfile::cone)
      each_point(0.0, 1.0,
                 [&](double t, double share) { ring(a * t * s, 2.0 * t * share * weight); });
  });
  return all;
}

}  // namespace tactile_net
