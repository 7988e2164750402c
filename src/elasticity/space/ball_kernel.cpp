#include "tactile_net/elasticity/space/ball_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "elasticity/space/ball_sums.hpp"
#include "elasticity/space/ball_tables.hpp"
#include "elasticity/space/layer_field.hpp"
#include "elasticity/space/reading_size.hpp"
#include "numeric/require.hpp"
#include "tactile_net/elasticity/space/space_vector.hpp"

namespace tactile_net {
namespace {

/// Beyond, sums would lose digits and take many seconds.
constexpr double most_radii_a_depth = 16000.0;

void check_ball(const Material& material, double radius, double depth) {
  require(material.layer && material.layer->base == Base::bonded,
          "a curved skin must be a layer that is bonded to its base: give its thickness, and no "
          "frictionless base");
  require_finite("radius", radius);
  require(radius != 0.0, "radius", "not be 0", radius);
  require(radius < 0.0 || material.layer->thickness < radius, "layer.thickness",
          "be less than the surface's least radius of curvature, " + shortest(radius),
          material.layer->thickness);
  const double least =
      std::min(std::abs(radius), farthest_ball * material.layer->thickness) / most_radii_a_depth;
  require(depth >= least, "depth",
          "be at least 1 / 16000 of the radius, or of 320 thicknesses where that is less: " +
              shortest(least),
          depth);
}

/// The place at the end of an arc, and how the frames are turned: the load's is brought along by
/// the least rotation.
BallPlace turned(const SurfaceFrame& load, const SurfaceFrame& taxel, double y, double z) noexcept {
  const SpaceVector& along = load[1];
  const double tilt = dot(along, taxel[0]) / (1.0 + dot(load[0], taxel[0]));
  return {.y = y,
          .z = z,
          .cosine = dot(along, taxel[1]) - tilt * dot(taxel[1], load[0]),
          .sine = dot(along, taxel[2]) - tilt * dot(taxel[2], load[0])};
}

}  // namespace

BallPlace ball_place(const SurfaceFrame& load, const SurfaceFrame& taxel, double radius) noexcept {
  const SpaceVector& from = load[0];
  const SpaceVector& to = taxel[0];
  const double cosine = dot(from, to);
  const double sine = length(cross(from, to));
  const double stretch = radius * (sine > 0.0 ? std::atan2(sine, cosine) / sine : 1.0);
  return turned(load, taxel, stretch * dot(taxel[1], from), stretch * dot(taxel[2], from));
}

BallPlace surface_place(const SurfaceFrame& load, const SurfaceFrame& taxel,
                        const SpaceVector& chord, double curvature) noexcept {
  const double y = dot(taxel[1], chord);
  const double z = dot(taxel[2], chord);
  const double along = std::hypot(y, z);
  if (!(along > 0.0)) return turned(load, taxel, 0.0, 0.0);
  const double straight = length(chord);
  // A chord that is longer than the ball is wide ends at its antipode, of which nothing is read.
  const double half = std::min(0.5 * std::abs(curvature) * straight, 1.0);
  const double arc = half > 0.0 ? 2.0 * std::asin(half) / std::abs(curvature) : straight;
  return turned(load, taxel, arc * y / along, arc * z / along);
}

BallKernel::BallKernel(const Material& material, double radius, double depth)
    : material_(material), radius_(radius), depth_(depth) {
  check(material);
  check_depth(material, depth);
  check_ball(material, radius, depth);
  const double h = material.layer->thickness;
  tables_ = std::make_shared<BallTables>(material.poisson_ratio, h / radius, depth / h);
}

template <std::size_t count>
std::array<double, count> BallKernel::read_at(Quantity quantity,
                                              const std::array<Traction, count>& components,
                                              double y, double z) const noexcept {
  constexpr double rounding = 1.0 + 1e-12;
  const double h = material_.layer->thickness;
  const double v = y / h;
  const double w = z / h;
  const double arc = std::sqrt(v * v + w * w);
  std::array<double, count> readings{};
  if (!(arc * h <= std::numbers::pi * std::abs(radius_) * rounding)) {
    readings.fill(std::numeric_limits<double>::quiet_NaN());
  } else if (arc <= tables_->end() * rounding) {
    const BallTables::Panels::At table = tables_->at(arc);
    for (std::size_t i = 0; i < count; ++i)
      readings[i] = layer_reading(quantity, components[i], material_, table, v, w);
  }
  return readings;
}

double BallKernel::operator()(Quantity quantity, Traction component, double y,
                              double z) const noexcept {
  return read_at(quantity, std::array{component}, y, z)[0];
}

void BallKernel::operator()(Quantity quantity, Traction component, std::span<const double> y,
                            std::span<const double> z, std::span<double> readings) const noexcept {
  assert(y.size() == readings.size() && z.size() == readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = (*this)(quantity, component, y[i], z[i]);
}

std::array<double, 3> BallKernel::operator()(Quantity quantity,
                                             const BallPlace& place) const noexcept {
  const auto [x, y, z] = read_at(quantity, skin_tractions, place.y, place.z);
  return {x, place.cosine * y + place.sine * z, place.cosine * z - place.sine * y};
}

double BallKernel::error_bound(Quantity quantity) const noexcept {
  const double core = radius_ / (radius_ - material_.layer->thickness);
  const double stress = 1.5 / std::numbers::pi / depth_ / depth_ * std::max(1.0, core * core);
  return 1e-12 * reading_size(quantity, stress, depth_, material_);
}

}  // namespace tactile_net
