#include "tactile_net/lab/skin_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "lab/convex_hull.hpp"
#include "numeric/require.hpp"

namespace tactile_net::lab {
namespace {

/// All points of one object, in the skin's coordinates.
struct SkinTouch {
  double curvature = 0.0;
  std::vector<PlanePoint> points{};
  double normal = 0.0;        // [N]
  double tangential_y = 0.0;  // [N]
  double tangential_z = 0.0;
  double moment_y = 0.0;  // of the normal forces: sum of y F [N m]
  double moment_z = 0.0;
  double torque = 0.0;  // sum of y F_z - z F_y [N m]

  void add(const ContactPoint& point) {
    const double y = point.along;
    const double z = -point.across;
    curvature = std::max(curvature, point.curvature);
    points.push_back({y, z});
    normal += point.normal;
    tangential_y += point.tangential;
    tangential_z -= point.sideways;
    moment_y += point.normal * y;
    moment_z += point.normal * z;
    torque += -y * point.sideways - z * point.tangential;
  }
  [[nodiscard]] PlanePoint centre() const noexcept {
    return {moment_y / normal, moment_z / normal};
  }
  /// About the centre of pressure.
  [[nodiscard]] double torsion() const noexcept {
    const PlanePoint at = centre();
    return torque - at.y * tangential_z + at.z * tangential_y;
  }
  /// The greatest distance between two points.
  [[nodiscard]] double length() const noexcept {
    double greatest = 0.0;
    for (const PlanePoint& a : points)
      for (const PlanePoint& b : points)
        greatest = std::max(greatest, std::hypot(a.y - b.y, a.z - b.z));
    return greatest;
  }
};

using Three = std::array<double, 3>;

/// Of a symmetric 3 x 3 system, by elimination with pivots; nothing where it is singular in double.
std::optional<Three> solved(std::array<Three, 3> matrix, Three right) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 3; ++i)
      if (std::abs(matrix[i][k]) > std::abs(matrix[pivot][k])) pivot = i;
    std::swap(matrix[k], matrix[pivot]);
    std::swap(right[k], right[pivot]);
    if (!(std::abs(matrix[k][k]) > 1e-12)) return std::nullopt;  // of entries of about 1
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = matrix[i][k] / matrix[k][k];
      for (std::size_t j = k; j < 3; ++j) matrix[i][j] -= factor * matrix[k][j];
      right[i] -= factor * right[k];
    }
  }
  Three found{};
  for (std::size_t k = 3; k-- > 0;) {
    double sum = right[k];
    for (std::size_t j = k + 1; j < 3; ++j) sum -= matrix[k][j] * found[j];
    found[k] = sum / matrix[k][k];
  }
  return found;
}

/// Some of a lattice's cells, and the shape of what presses on them.
struct Raster {
  std::size_t rows, columns;
  double first_y, first_z;  // the middle of the first cell
  double spacing_y, spacing_z;
  std::vector<double> shape{};  // of each cell: what of it is covered, or Hertz' profile

  [[nodiscard]] double y(std::size_t i) const noexcept {
    return first_y + static_cast<double>(i / columns) * spacing_y;
  }
  [[nodiscard]] double z(std::size_t i) const noexcept {
    return first_z + static_cast<double>(i % columns) * spacing_z;
  }
  [[nodiscard]] double area() const noexcept { return spacing_y * spacing_z; }
  [[nodiscard]] double middle_y() const noexcept {
    return first_y + 0.5 * static_cast<double>(rows - 1) * spacing_y;
  }
  [[nodiscard]] double middle_z() const noexcept {
    return first_z + 0.5 * static_cast<double>(columns - 1) * spacing_z;
  }
};

/// The cells that a rectangle touches, without a shape.
Raster cells_between(const SurfaceGrid& grid, PlanePoint low, PlanePoint high) {
  const auto cells = [](double first, double spacing, double from, double to) {
    const double begin = std::floor((from - first) / spacing + 0.5);
    const double end = std::floor((to - first) / spacing + 0.5);
    return std::pair(first + begin * spacing, end - begin + 1.0);
  };
  const auto [y, rows] = cells(grid.y(0), grid.spacing_y, low.y, high.y);
  const auto [z, columns] = cells(grid.z(0), grid.spacing_z, low.z, high.z);
  require(rows * columns <= static_cast<double>(most_touched_cells), "a contact",
          "must not cover more than " + std::to_string(most_touched_cells) +
              " cells of the skin: are the lengths of the model those of the scene?",
          rows * columns);
  return {.rows = static_cast<std::size_t>(rows),
          .columns = static_cast<std::size_t>(columns),
          .first_y = y,
          .first_z = z,
          .spacing_y = grid.spacing_y,
          .spacing_z = grid.spacing_z};
}

Raster raster_of(const std::vector<PlanePoint>& hull, const SurfaceGrid& grid) {
  PlanePoint low = hull.front();
  PlanePoint high = low;
  for (const PlanePoint& point : hull) {
    low = {std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.y, point.y), std::max(high.z, point.z)};
  }
  Raster raster = cells_between(grid, low, high);
  const double half_y = 0.5 * raster.spacing_y;
  const double half_z = 0.5 * raster.spacing_z;
  for (std::size_t i = 0; i < raster.rows * raster.columns; ++i)
    raster.shape.push_back(area_within(hull, raster.y(i) - half_y, raster.y(i) + half_y,
                                       raster.z(i) - half_z, raster.z(i) + half_z) /
                           raster.area());
  return raster;
}

/// Hertz' pressure on a circle, over its peak: at four by four places of a cell.
Raster hertz_raster(PlanePoint centre, double radius, const SurfaceGrid& grid) {
  Raster raster = cells_between(grid, {centre.y - radius, centre.z - radius},
                                {centre.y + radius, centre.z + radius});
  for (std::size_t i = 0; i < raster.rows * raster.columns; ++i) {
    double sum = 0.0;
    for (const double part_y : {-0.375, -0.125, 0.125, 0.375})
      for (const double part_z : {-0.375, -0.125, 0.125, 0.375}) {
        const double off = std::hypot(raster.y(i) + part_y * raster.spacing_y - centre.y,
                                      raster.z(i) + part_z * raster.spacing_z - centre.z) /
                           radius;
        if (off < 1.0) sum += std::sqrt(1.0 - off * off);
      }
    raster.shape.push_back(sum / 16.0);
  }
  return raster;
}

/// A point load on three by three cells, by quadratic B-splines: force and centre are its own.
Raster point_raster(PlanePoint at, const SurfaceGrid& grid) {
  Raster raster = cells_between(grid, at, at);
  const auto shares = [](double off) {
    return Three{0.5 * (0.5 - off) * (0.5 - off), 0.75 - off * off,
                 0.5 * (0.5 + off) * (0.5 + off)};
  };
  const Three along_y = shares((at.y - raster.first_y) / raster.spacing_y);
  const Three along_z = shares((at.z - raster.first_z) / raster.spacing_z);
  raster.rows = raster.columns = 3;
  raster.first_y -= raster.spacing_y;
  raster.first_z -= raster.spacing_z;
  for (const double share_y : along_y)
    for (const double share_z : along_z) raster.shape.push_back(share_y * share_z);
  return raster;
}

/// The shape times max(0, linear) in each cell, with this force and its centre: by Newton's method,
/// whose every step is the linear factor over what pressed in the step before. Nothing where no
/// such traction is found: the force acts too near the rim, or on too few cells.
std::optional<std::vector<double>> linear_pressure(const Raster& raster, double force,
                                                   PlanePoint centre) {
  const double half_y = 0.5 * static_cast<double>(raster.rows) * raster.spacing_y;
  const double half_z = 0.5 * static_cast<double>(raster.columns) * raster.spacing_z;
  const std::size_t n = raster.shape.size();
  double whole = 0.0;
  for (const double share : raster.shape) whole += share;
  const auto place = [&](std::size_t i) {
    return Three{1.0, (raster.y(i) - raster.middle_y()) / half_y,
                 (raster.z(i) - raster.middle_z()) / half_z};
  };
  const Three wanted{1.0, (centre.y - raster.middle_y()) / half_y,
                     (centre.z - raster.middle_z()) / half_z};
  std::vector<bool> presses(n, true);
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    std::array<Three, 3> matrix{};
    for (std::size_t i = 0; i < n; ++i) {
      if (!presses[i]) continue;
      const Three at = place(i);
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) matrix[j][k] += raster.shape[i] / whole * at[j] * at[k];
    }
    const auto plane = solved(matrix, wanted);
    if (!plane) return std::nullopt;
    std::vector<double> pressure(n);
    bool same = true;
    for (std::size_t i = 0; i < n; ++i) {
      const Three at = place(i);
      const double value = (*plane)[0] + (*plane)[1] * at[1] + (*plane)[2] * at[2];
      same = same && (value > 0.0) == presses[i];
      presses[i] = value > 0.0;
      if (presses[i]) pressure[i] = force / (raster.area() * whole) * raster.shape[i] * value;
    }
    if (same) return pressure;
  }
  return std::nullopt;
}

SampledPatch patch_on(const Raster& raster, std::vector<double> pressure, const SkinTouch& touch) {
  const PlanePoint centre = touch.centre();
  const std::size_t n = pressure.size();
  const auto arm = [&](std::size_t i) {
    return PlanePoint{raster.y(i) - centre.y, raster.z(i) - centre.z};
  };
  double lever = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    lever += raster.area() * pressure[i] * (arm(i).y * arm(i).y + arm(i).z * arm(i).z);
  const double spin = lever > 0.0 ? touch.torsion() / lever : 0.0;
  SampledPatch patch{.rows = raster.rows,
                     .columns = raster.columns,
                     .y = raster.middle_y(),
                     .z = raster.middle_z(),
                     .spacing_y = raster.spacing_y,
                     .spacing_z = raster.spacing_z};
  if (touch.tangential_y != 0.0 || touch.tangential_z != 0.0 || touch.torque != 0.0) {
    for (std::size_t i = 0; i < n; ++i) {
      patch.tangential_y.push_back(pressure[i] *
                                   (touch.tangential_y / touch.normal - spin * arm(i).z));
      patch.tangential_z.push_back(pressure[i] *
                                   (touch.tangential_z / touch.normal + spin * arm(i).y));
    }
  }
  patch.normal = std::move(pressure);
  return patch;
}

/// Of a shape where it can bear the force, else as a point load.
SampledPatch patch_of(const Raster& raster, const SkinTouch& touch, const SurfaceGrid& grid) {
  if (auto pressure = linear_pressure(raster, touch.normal, touch.centre()))
    return patch_on(raster, std::move(*pressure), touch);
  const Raster point = point_raster(touch.centre(), grid);
  std::vector<double> pressure = point.shape;
  for (double& one : pressure) one *= touch.normal / point.area();
  return patch_on(point, std::move(pressure), touch);
}

Raster shape_of(const SkinTouch& touch, const Material& pad, double edge, const SurfaceGrid& grid) {
  if (!(touch.curvature > 0.0)) return raster_of(widened_hull(touch.points, edge), grid);
  const double nu = pad.poisson_ratio;
  const double modulus = pad.youngs_modulus / (1.0 - nu * nu);
  const double radius = std::cbrt(3.0 * touch.normal / (4.0 * modulus * touch.curvature));
  const double length = touch.length();
  if (length <= 2.0 * radius) return hertz_raster(touch.centre(), radius, grid);
  const double strip =
      2.0 * std::sqrt(4.0 * touch.normal / length / (std::numbers::pi * modulus * touch.curvature));
  return raster_of(widened_hull(touch.points, strip), grid);
}

}  // namespace

std::vector<SampledPatch> skin_patches(std::span<const ContactPoint> points, const Material& pad,
                                       double edge, const SurfaceGrid& grid) {
  check(pad);
  require_positive("edge_width", edge);
  std::map<std::size_t, SkinTouch> touches;
  for (const ContactPoint& point : points)
    if (point.normal > 0.0) touches[point.object].add(point);
  std::vector<SampledPatch> patches;
  for (const auto& [object, touch] : touches)
    patches.push_back(patch_of(shape_of(touch, pad, edge, grid), touch, grid));
  return patches;
}

}  // namespace tactile_net::lab
