/// @file
/// The half space in 100 digits, from the displacements that textbooks print: stresses by Hooke's
/// law of their differences, which costs half of the digits.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net::test {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                           boost::multiprecision::et_off>;
using Vector = std::array<Real, 3>;
using Tensor = std::array<Vector, 3>;

/// Displacements under a unit force (Johnson 1985, 3.19 and 3.75), of a half space with E = 1.
inline Vector textbook_displacement(Axis load, const Real& nu, const Vector& place) {
  const auto& [x, y, z] = place;
  const Real r = sqrt(x * x + y * y + z * z);
  const Real s = r + x;
  const Real m = 1 - 2 * nu;
  const Real scale = (1 + nu) / (2 * boost::math::constants::pi<Real>());
  const Real r3 = r * r * r;
  if (load == Axis::x)
    return {scale * (x * x / r3 + 2 * (1 - nu) / r), scale * (x * y / r3 - m * y / (r * s)),
            scale * (x * z / r3 - m * z / (r * s))};
  if (load == Axis::y)
    return {scale * (x * y / r3 + m * y / (r * s)),
            scale * (1 / r + y * y / r3 + m * (1 / s - y * y / (r * s * s))),
            scale * (y * z / r3 - m * y * z / (r * s * s))};
  const Vector turned = textbook_displacement(Axis::y, nu, {x, z, y});
  return {turned[0], turned[2], turned[1]};
}

/// Compression positive: Hooke's law of -(u_a,b + u_b,a) / 2, by central differences.
template <class Displacement>
Tensor stress_of(const Displacement& displacement, const Real& nu, const Vector& place) {
  const Real step = place[0] * Real("1e-30");
  Tensor slope;  // [a][b] = u_a,b
  for (std::size_t b = 0; b < 3; ++b) {
    Vector ahead = place;
    Vector behind = place;
    ahead[b] += step;
    behind[b] -= step;
    const Vector u = displacement(ahead);
    const Vector v = displacement(behind);
    for (std::size_t a = 0; a < 3; ++a) slope[a][b] = (u[a] - v[a]) / (2 * step);
  }
  const Real stiffness = 1 / (1 + nu);
  const Real volume = slope[0][0] + slope[1][1] + slope[2][2];
  Tensor stress;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      stress[a][b] = -stiffness * ((slope[a][b] + slope[b][a]) / 2 +
                                   (a == b ? nu / (1 - 2 * nu) * volume : Real(0)));
  return stress;
}

}  // namespace tactile_net::test
