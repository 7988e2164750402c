#include "lab/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace tactile_net::lab {
namespace {

/// > 0 where c lies to the left of the way from a to b.
double turn(PlanePoint a, PlanePoint b, PlanePoint c) noexcept {
  return (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
}

/// Extent of points along a direction.
std::pair<double, double> extent(const std::vector<PlanePoint>& points, double y, double z) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const PlanePoint& point : points) {
    const double at = y * point.y + z * point.z;
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {low, high};
}

/// The part on the side of a line where y * point.y + z * point.z <= limit.
std::vector<PlanePoint> cut(const std::vector<PlanePoint>& polygon, double y, double z,
                            double limit) {
  std::vector<PlanePoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint a = polygon[i];
    const PlanePoint b = polygon[(i + 1) % polygon.size()];
    const double of_a = y * a.y + z * a.z - limit;
    const double of_b = y * b.y + z * b.z - limit;
    if (of_a <= 0.0) kept.push_back(a);
    if ((of_a < 0.0) == (of_b < 0.0) || of_a == 0.0 || of_b == 0.0) continue;
    const double share = of_a / (of_a - of_b);
    kept.push_back({std::lerp(a.y, b.y, share), std::lerp(a.z, b.z, share)});
  }
  return kept;
}

}  // namespace

std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points) {
  const auto before = [](PlanePoint a, PlanePoint b) {
    return std::pair(a.y, a.z) < std::pair(b.y, b.z);
  };
  std::sort(points.begin(), points.end(), before);
  std::vector<PlanePoint> hull;
  // Andrew's monotone chain: the lower side from left to right, then the upper one back.
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const PlanePoint& point : points) {
      while (hull.size() >= first + 2 && !(turn(hull[hull.size() - 2], hull.back(), point) > 0.0))
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();  // begins the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<PlanePoint> widened_hull(const std::vector<PlanePoint>& points, double width) {
  // The least width of a convex polygon is across one of its sides; of a line it is 0 across it.
  double narrowest = std::numeric_limits<double>::infinity();
  double y = 1.0;
  double z = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double dy = points[j].y - points[i].y;
      const double dz = points[j].z - points[i].z;
      const double length = std::hypot(dy, dz);
      if (!(length > 0.0)) continue;
      const auto [low, high] = extent(points, -dz / length, dy / length);
      if (high - low < narrowest) {
        narrowest = high - low;
        y = -dz / length;
        z = dy / length;
      }
    }
  std::vector<PlanePoint> wide = points;
  for (int direction = 0; direction < 2; ++direction) {
    const auto [low, high] = extent(wide, y, z);
    const double missing = 0.5 * (width - (high - low));
    if (missing > 0.0) {
      std::vector<PlanePoint> both;
      for (const PlanePoint& point : wide) {
        both.push_back({point.y - missing * y, point.z - missing * z});
        both.push_back({point.y + missing * y, point.z + missing * z});
      }
      wide = std::move(both);
    }
    std::tie(y, z) = std::pair(-z, y);
  }
  return convex_hull(std::move(wide));
}

double area_within(const std::vector<PlanePoint>& polygon, double from_y, double to_y,
                   double from_z, double to_z) {
  bool is_inside = true;  // as most rectangles are: nothing is cut
  for (std::size_t i = 0; is_inside && i < polygon.size(); ++i) {
    const PlanePoint a = polygon[i];
    const PlanePoint b = polygon[(i + 1) % polygon.size()];
    for (const double y : {from_y, to_y})
      for (const double z : {from_z, to_z}) is_inside = is_inside && turn(a, b, {y, z}) >= 0.0;
  }
  if (is_inside) return (to_y - from_y) * (to_z - from_z);
  const std::vector<PlanePoint> part =
      cut(cut(cut(cut(polygon, 1.0, 0.0, to_y), -1.0, 0.0, -from_y), 0.0, 1.0, to_z), 0.0, -1.0,
          -from_z);
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < part.size(); ++i)
    area += 0.5 * turn(part[0], part[i], part[i + 1]);
  return area;
}

}  // namespace tactile_net::lab
