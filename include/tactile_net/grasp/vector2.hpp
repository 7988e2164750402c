/// @file
/// Vectors of the hand's plane: X to the right, Y up, angles counter-clockwise.
#pragma once

#include <cmath>

namespace tactile_net {

struct Vector2 {
  double x = 0.0;
  double y = 0.0;

  friend Vector2 operator+(Vector2 a, Vector2 b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend Vector2 operator-(Vector2 a, Vector2 b) noexcept { return {a.x - b.x, a.y - b.y}; }
  friend Vector2 operator-(Vector2 a) noexcept { return {-a.x, -a.y}; }
  friend Vector2 operator*(double s, Vector2 a) noexcept { return {s * a.x, s * a.y}; }
};

[[nodiscard]] inline double dot(Vector2 a, Vector2 b) noexcept { return a.x * b.x + a.y * b.y; }

/// The out-of-plane part of a x b: the moment of b at a, counter-clockwise.
[[nodiscard]] inline double cross(Vector2 a, Vector2 b) noexcept { return a.x * b.y - a.y * b.x; }

[[nodiscard]] inline double length(Vector2 a) noexcept { return std::hypot(a.x, a.y); }

/// The vector of length 1 at `angle` [rad] from X.
[[nodiscard]] inline Vector2 direction(double angle) noexcept {
  return {std::cos(angle), std::sin(angle)};
}

/// The vector turned by 90 degrees counter-clockwise.
[[nodiscard]] inline Vector2 quarter_turn(Vector2 a) noexcept { return {-a.y, a.x}; }

}  // namespace tactile_net
