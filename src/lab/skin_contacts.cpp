#include "tactile_net/lab/skin_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "lab/convex_hull.hpp"
#include "numeric/require.hpp"

namespace tactile_net::lab {
namespace {

/// All points of one object, in the skin's coordinates.
struct Touch {
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

SkinContact circle(const Touch& touch, double radius) {
  const PlanePoint at = touch.centre();
  return {.shape = SkinShape::sphere,
          .y = at.y,
          .z = at.z,
          .radius = radius,
          .force = touch.normal,
          .friction = std::hypot(touch.tangential_y, touch.tangential_z) / touch.normal,
          .direction = std::atan2(touch.tangential_z, touch.tangential_y),
          .torsion = touch.torsion()};
}

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

/// Rectangles of which a hull covers a part.
struct Raster {
  std::size_t rows, columns;
  double from_y, from_z, spacing_y, spacing_z;
  std::vector<double> covered{};  // share of each rectangle

  [[nodiscard]] double y(std::size_t i) const noexcept {
    return from_y + (static_cast<double>(i / columns) + 0.5) * spacing_y;
  }
  [[nodiscard]] double z(std::size_t i) const noexcept {
    return from_z + (static_cast<double>(i % columns) + 0.5) * spacing_z;
  }
  [[nodiscard]] double area() const noexcept { return spacing_y * spacing_z; }
};

constexpr double most_rectangles = 12.0;  // along the longer side
constexpr double least_rectangles = 4.0;

Raster raster_of(const std::vector<PlanePoint>& hull) {
  PlanePoint low = hull.front();
  PlanePoint high = low;
  for (const PlanePoint& point : hull) {
    low = {std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.y, point.y), std::max(high.z, point.z)};
  }
  const double longer = std::max(high.y - low.y, high.z - low.z);
  const auto count = [&](double side) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(most_rectangles * side / longer), least_rectangles, most_rectangles));
  };
  Raster raster{.rows = count(high.y - low.y),
                .columns = count(high.z - low.z),
                .from_y = low.y,
                .from_z = low.z,
                .spacing_y = 0.0,
                .spacing_z = 0.0};
  raster.spacing_y = (high.y - low.y) / static_cast<double>(raster.rows);
  raster.spacing_z = (high.z - low.z) / static_cast<double>(raster.columns);
  for (std::size_t i = 0; i < raster.rows * raster.columns; ++i) {
    const double half_y = 0.5 * raster.spacing_y;
    const double half_z = 0.5 * raster.spacing_z;
    raster.covered.push_back(area_within(hull, raster.y(i) - half_y, raster.y(i) + half_y,
                                         raster.z(i) - half_z, raster.z(i) + half_z) /
                             raster.area());
  }
  return raster;
}

/// The mean of max(0, linear) in each rectangle, with this force and its centre: by Newton's
/// method, whose every step is the linear traction over what pressed in the step before. Nothing
/// where no such traction is found: the force acts too near the hull's rim.
std::optional<std::vector<double>> linear_pressure(const Raster& raster, double force,
                                                   PlanePoint centre) {
  const double middle_y = raster.from_y + 0.5 * raster.spacing_y * static_cast<double>(raster.rows);
  const double middle_z =
      raster.from_z + 0.5 * raster.spacing_z * static_cast<double>(raster.columns);
  const double half_y = middle_y - raster.from_y;
  const double half_z = middle_z - raster.from_z;
  const std::size_t n = raster.covered.size();
  const auto place = [&](std::size_t i) {
    return Three{1.0, (raster.y(i) - middle_y) / half_y, (raster.z(i) - middle_z) / half_z};
  };
  const Three wanted{1.0, (centre.y - middle_y) / half_y, (centre.z - middle_z) / half_z};
  std::vector<bool> presses(n, true);
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    std::array<Three, 3> matrix{};
    for (std::size_t i = 0; i < n; ++i) {
      if (!presses[i]) continue;
      const Three at = place(i);
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) matrix[j][k] += raster.covered[i] * at[j] * at[k];
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
      if (presses[i]) pressure[i] = force / raster.area() * raster.covered[i] * value;
    }
    if (same) return pressure;
  }
  return std::nullopt;
}

SampledPatch patch_on(const Raster& raster, std::vector<double> pressure, const Touch& touch) {
  const PlanePoint centre = touch.centre();
  const std::size_t n = pressure.size();
  const auto arm = [&](std::size_t i) {
    return PlanePoint{raster.y(i) - centre.y, raster.z(i) - centre.z};
  };
  double lever = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    lever += raster.area() * pressure[i] * (arm(i).y * arm(i).y + arm(i).z * arm(i).z);
  const double spin = lever > 0.0 ? touch.torsion() / lever : 0.0;
  SampledPatch patch{
      .rows = raster.rows,
      .columns = raster.columns,
      .y = raster.from_y + 0.5 * raster.spacing_y * static_cast<double>(raster.rows),
      .z = raster.from_z + 0.5 * raster.spacing_z * static_cast<double>(raster.columns),
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

SampledPatch flat(const Touch& touch, double width) {
  const Raster raster = raster_of(widened_hull(touch.points, width));
  if (auto pressure = linear_pressure(raster, touch.normal, touch.centre()))
    return patch_on(raster, std::move(*pressure), touch);
  // All of it at one corner or side: a square around where the force acts.
  const Raster square = raster_of(widened_hull({touch.centre()}, width));
  return patch_on(square,
                  std::vector<double>(
                      square.covered.size(),
                      touch.normal / (square.area() * static_cast<double>(square.covered.size()))),
                  touch);
}

SkinLoad load_of(const Touch& touch, const Material& pad, double edge) {
  if (!(touch.curvature > 0.0)) return flat(touch, edge);
  const double nu = pad.poisson_ratio;
  const double modulus = pad.youngs_modulus / (1.0 - nu * nu);
  const double radius = std::cbrt(3.0 * touch.normal / (4.0 * modulus * touch.curvature));
  const double length = touch.length();
  if (length <= 2.0 * radius) return circle(touch, radius);
  // A line, as wide as Hertz' strip under its force per length.
  return flat(touch, 2.0 * std::sqrt(4.0 * touch.normal / length /
                                     (std::numbers::pi * modulus * touch.curvature)));
}

}  // namespace

std::vector<SkinLoad> skin_loads(std::span<const ContactPoint> points, const Material& pad,
                                 double edge) {
  check(pad);
  require_positive("edge_width", edge);
  std::map<std::size_t, Touch> touches;
  for (const ContactPoint& point : points)
    if (point.normal > 0.0) touches[point.object].add(point);
  std::vector<SkinLoad> loads;
  for (const auto& [object, touch] : touches) loads.push_back(load_of(touch, pad, edge));
  return loads;
}

}  // namespace tactile_net::lab
