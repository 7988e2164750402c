#include "tactile_net/skin/curved_surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tactile_net {
namespace {

bool is_finite(const SpaceVector& one) noexcept {
  return std::all_of(one.begin(), one.end(), [](double x) { return std::isfinite(x); });
}

/// cos 10 degrees.
constexpr double too_near = 0.984807753012208;

/// Gauss' three points on [-1/2, 1/2].
constexpr std::array<double, 3> gauss_points = {-0.3872983346207417, 0.0, 0.3872983346207417};
constexpr std::array<double, 3> gauss_weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

SurfaceFrame tangent_frame(const SpaceVector& reference, const SpaceVector& outward) {
  const double along = dot(reference, outward);
  if (!(std::abs(along) < too_near))
    throw std::invalid_argument(
        "the reference direction is within 10 degrees of the surface's normal, where it gives the "
        "surface no y: choose one that lies along all of the surface, of a finger along it, or "
        "frames = \"carried\"");
  const SpaceVector tangent = combined(1.0, reference, -along, outward);
  const SpaceVector y = multiple(1.0 / length(tangent), tangent);
  const SpaceVector x = multiple(-1.0, outward);
  return {x, y, cross(x, y)};
}

}  // namespace

std::vector<HeightField::Value> HeightField::terms(double y, double z) const {
  std::vector<double> of_y(degree + 1, 1.0);
  std::vector<double> of_z(degree + 1, 1.0);
  for (std::size_t k = 1; k <= degree; ++k) {
    of_y[k] = of_y[k - 1] * (y / length);
    of_z[k] = of_z[k - 1] * (z / length);
  }
  const double outward = std::hypot(y / end_y, z / end_z);
  std::vector<Value> all;
  all.reserve((degree + 1) * (degree + 2) / 2);
  for (std::size_t powers = 0; powers <= degree; ++powers) {
    const std::size_t first = all.size();
    for (std::size_t k = 0; k <= powers; ++k) {
      const std::size_t j = powers - k;
      all.push_back({of_y[j] * of_z[k],
                     j == 0 ? 0.0 : static_cast<double>(j) * of_y[j - 1] * of_z[k] / length,
                     k == 0 ? 0.0 : static_cast<double>(k) * of_y[j] * of_z[k - 1] / length});
    }
    if (!(outward > 1.0)) continue;
    // Terms of one degree m grow as r^m along a ray, and beyond r = 1 as 1 + m (r - 1).
    const auto m = static_cast<double>(powers);
    const double straight = 1.0 + m * (outward - 1.0);
    const double shrunk = std::pow(outward, -m);
    const double by_outward = m * shrunk * (1.0 - straight / outward);
    for (std::size_t i = first; i < all.size(); ++i) {
      Value& one = all[i];
      one.slope_y = one.slope_y * straight * shrunk +
                    one.height * by_outward * (y / end_y) / (end_y * outward);
      one.slope_z = one.slope_z * straight * shrunk +
                    one.height * by_outward * (z / end_z) / (end_z * outward);
      one.height *= straight * shrunk;
    }
  }
  return all;
}

HeightField::Value HeightField::at(double y, double z) const {
  Value value;
  if (coefficients.empty()) return value;
  const std::vector<Value> all = terms(y, z);
  for (std::size_t i = 0; i < all.size(); ++i) {
    value.height += coefficients[i] * all[i].height;
    value.slope_y += coefficients[i] * all[i].slope_y;
    value.slope_z += coefficients[i] * all[i].slope_z;
  }
  return value;
}

CurvedSurface::CurvedSurface(const SpaceVector& apex, const SpaceVector& outward, double curvature,
                             const SpaceVector& reference, SurfaceFrames frames)
    : apex_(apex), curvature_(curvature), reference_(reference), frames_(frames) {
  if (!is_finite(apex) || !is_finite(outward) || !std::isfinite(curvature) || !is_finite(reference))
    throw std::invalid_argument("a surface's apex, normal, curvature and reference must be finite");
  if (!(std::abs(length(outward) - 1.0) <= 1e-9))
    throw std::invalid_argument("a surface's outward normal must be a unit vector");
  if (!(length(reference) > 0.0))
    throw std::invalid_argument("a surface's reference must not be 0");
  reference_ = multiple(1.0 / length(reference), reference);
  axes_ = tangent_frame(reference_, outward);
}

CurvedSurface CurvedSurface::raised(HeightField height) const {
  CurvedSurface other = *this;
  other.height_ = std::move(height);
  return other;
}

CurvedSurface CurvedSurface::bent(double curvature) const {
  CurvedSurface other = *this;
  other.curvature_ = curvature;
  return other;
}

SurfaceFrame CurvedSurface::frame(const SpaceVector& outward) const {
  if (frames_ == SurfaceFrames::tangent) return tangent_frame(reference_, outward);
  const SpaceVector x = multiple(-1.0, outward);
  const double nearness = dot(axes_[0], x);
  if (!(nearness > -too_near))
    throw std::invalid_argument(
        "the surface faces the opposite of the middle of the taxels, where no frame is carried "
        "to: give the skin in parts, or choose a smaller margin");
  const SpaceVector both = combined(1.0, axes_[0], 1.0, x);
  const SpaceVector y = combined(1.0, axes_[1], -dot(axes_[1], x) / (1.0 + nearness), both);
  return {x, y, cross(x, y)};
}

CurvedSurface::Tangents CurvedSurface::tangents(double y, double z) const {
  const SpaceVector& inward = axes_[0];
  const double k = curvature_;
  const double s = std::hypot(y, z);
  if (!(std::abs(k) * s <= 2.0 * std::sin(0.5 * most_angle)))
    throw std::invalid_argument(
        "the surface turns by more than 150 degrees from the middle of the taxels: give the skin "
        "in parts, or choose a smaller margin");
  // Lambert's chart: sin g = k s c and 1 - cos g = k^2 s^2 / 2 of the angle g from the apex.
  const double c = std::sqrt(1.0 - 0.25 * k * k * s * s);
  const SpaceVector flat = combined(y, axes_[1], z, axes_[2]);
  const double half = 0.5 * s * s * k;
  SpaceVector point = combined(1.0, apex_, c, flat);
  point = combined(1.0, point, half, inward);
  const auto moved = [&](double by, const SpaceVector& axis) {  // of the sphere's point
    const double dc = -0.25 * k * k * by / c;
    return combined(1.0, combined(c, axis, dc, flat), k * by, inward);
  };
  SpaceVector along_y = moved(y, axes_[1]);
  SpaceVector along_z = moved(z, axes_[2]);
  if (!height_.coefficients.empty()) {
    const HeightField::Value above = height_.at(y, z);
    const SpaceVector normal = combined(-(1.0 - k * half), inward, k * c, flat);
    // The normal moves by the curvature times what the point moves by.
    along_y = combined(1.0 + k * above.height, along_y, above.slope_y, normal);
    along_z = combined(1.0 + k * above.height, along_z, above.slope_z, normal);
    point = combined(1.0, point, above.height, normal);
  }
  return {point, along_y, along_z};
}

SurfacePlace CurvedSurface::at(double y, double z) const {
  if (!height_.known.holds(y, z))
    throw std::invalid_argument(
        "the surface is followed for four depths beyond the outermost taxels, and its cells lie "
        "further out: choose a smaller margin");
  const Tangents here = tangents(y, z);
  const auto normal_of = [](const Tangents& one) {  // inward is y cross z
    return cross(one.along_z, one.along_y);
  };
  const SpaceVector normal = normal_of(here);
  const double area = length(normal);
  SurfacePlace place{
      .point = here.point, .frame = frame(multiple(1.0 / area, normal)), .stretch = area};
  if (height_.coefficients.empty()) {
    place.mean_curvature = curvature_;
    return place;
  }
  // Half the trace of the normal's derivative along the surface.
  const double step = 1e-4 * height_.length;
  const auto turn = [&](double dy, double dz) {
    const auto unit = [&](double sign) {
      const SpaceVector n = normal_of(tangents(y + sign * dy, z + sign * dz));
      return multiple(1.0 / length(n), n);
    };
    return multiple(0.5 / step, combined(1.0, unit(1.0), -1.0, unit(-1.0)));
  };
  const SpaceVector turn_y = turn(step, 0.0);
  const SpaceVector turn_z = turn(0.0, step);
  const double yy = dot(here.along_y, here.along_y);
  const double yz = dot(here.along_y, here.along_z);
  const double zz = dot(here.along_z, here.along_z);
  const double area_squared = yy * zz - yz * yz;
  const double bend_yy = dot(turn_y, here.along_y);
  const double bend_yz = 0.5 * (dot(turn_y, here.along_z) + dot(turn_z, here.along_y));
  const double bend_zz = dot(turn_z, here.along_z);
  const double mean = 0.5 * (zz * bend_yy - 2.0 * yz * bend_yz + yy * bend_zz) / area_squared;
  const double product = (bend_yy * bend_zz - bend_yz * bend_yz) / area_squared;
  place.mean_curvature = mean;
  place.curvature_difference = 2.0 * std::sqrt(std::max(mean * mean - product, 0.0));
  return place;
}

CurvedSurface::Charted CurvedSurface::chart(const SpaceVector& point) const {
  const SpaceVector from = combined(1.0, point, -1.0, apex_);
  const double k = curvature_;
  const double outward = -dot(axes_[0], from);
  const SpaceVector flat = combined(1.0, from, outward, axes_[0]);
  const double y = dot(axes_[1], flat);
  const double z = dot(axes_[2], flat);
  const double t = std::hypot(y, z);
  // From the sphere's centre, in radii: t k along the surface, 1 + k outward along the axis.
  const double beyond = k * (2.0 * outward + k * (outward * outward + t * t));
  const double distance = std::sqrt(std::max(1.0 + beyond, 0.0));
  const double above = (2.0 * outward + k * (outward * outward + t * t)) / (1.0 + distance);
  const double cosine = (1.0 + k * outward) / distance;
  const double stretch = std::sqrt(2.0 / (1.0 + cosine)) / distance;
  const Charted at{.y = stretch * y, .z = stretch * z};
  return {.y = at.y, .z = at.z, .outside = above - height_.at(at.y, at.z).height};
}

std::vector<SurfaceCell> CurvedSurface::cells(const SurfaceGrid& grid) const {
  std::vector<SurfaceCell> all;
  all.reserve(grid.count());
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      SurfaceCell cell{.middle = at(grid.y(row), grid.z(column))};
      for (std::size_t i = 0; i < gauss_points.size(); ++i)
        for (std::size_t j = 0; j < gauss_points.size(); ++j) {
          const Tangents here = tangents(grid.y(row) + gauss_points[i] * grid.spacing_y,
                                         grid.z(column) + gauss_points[j] * grid.spacing_z);
          const SpaceVector normal = cross(here.along_z, here.along_y);
          const double stretch = length(normal);
          const double area = gauss_weights[i] * gauss_weights[j] * grid.area() * stretch;
          const SurfaceFrame turned = frame(multiple(1.0 / stretch, normal));
          cell.area += area;
          cell.first_moment = combined(1.0, cell.first_moment, area, here.point);
          for (std::size_t u = 0; u < turned.size(); ++u) {
            cell.force[u] = combined(1.0, cell.force[u], area, turned[u]);
            cell.moment[u] = combined(1.0, cell.moment[u], area, cross(here.point, turned[u]));
          }
        }
      all.push_back(cell);
    }
  return all;
}

}  // namespace tactile_net
