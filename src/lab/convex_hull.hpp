/// @file
/// Convex polygons, as the contact points of an object span them.
#pragma once

#include <vector>

namespace tactile_net::lab {

struct PlanePoint {
  double y = 0.0;
  double z = 0.0;
};

/// Counter-clockwise from y to z, without repetition; fewer than three points where they lie on a
/// line.
[[nodiscard]] std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

/// The hull of points, made at least `width` wide in every direction: by what is missing, evenly
/// on both sides.
[[nodiscard]] std::vector<PlanePoint> widened_hull(const std::vector<PlanePoint>& points,
                                                   double width);

/// Area of the part of a convex polygon that lies in a rectangle.
[[nodiscard]] double area_within(const std::vector<PlanePoint>& polygon, double from_y, double to_y,
                                 double from_z, double to_z);

}  // namespace tactile_net::lab
