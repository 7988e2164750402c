/// @file
/// Vectors in space: the hand's frame X, Y, Z, right-handed.
#pragma once

#include <cmath>

namespace tactile_net {

struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend Vector3 operator+(Vector3 a, Vector3 b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector3 operator-(Vector3 a, Vector3 b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector3 operator-(Vector3 a) noexcept { return {-a.x, -a.y, -a.z}; }
  friend Vector3 operator*(double s, Vector3 a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
  bool operator==(const Vector3&) const = default;
};

[[nodiscard]] inline double dot(Vector3 a, Vector3 b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// a x b: the moment of the force b that acts at a.
[[nodiscard]] inline Vector3 cross(Vector3 a, Vector3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[nodiscard]] inline double length(Vector3 a) noexcept { return std::hypot(a.x, a.y, a.z); }

[[nodiscard]] inline bool is_finite(Vector3 a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace tactile_net
