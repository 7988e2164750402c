/// @file
/// One cone of second order, x_0 >= |(x_1, x_2, ...)|: its algebra and its scaling. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/eigen.hpp"

namespace tactile_net::lorentz {

using Segment = Eigen::Ref<const Eigen::VectorXd>;

/// x_0 - |x_1...|: > 0 inside.
[[nodiscard]] inline double slack(const Segment& x) { return x(0) - x.tail(x.size() - 1).norm(); }

/// x_0^2 - |x_1...|^2, as a product.
[[nodiscard]] inline double determinant(const Segment& x) {
  const double size = x.tail(x.size() - 1).norm();
  return (x(0) - size) * (x(0) + size);
}

[[nodiscard]] inline Eigen::VectorXd product(const Segment& a, const Segment& b) {
  Eigen::VectorXd p(a.size());
  p(0) = a.dot(b);
  p.tail(a.size() - 1) = a(0) * b.tail(a.size() - 1) + b(0) * a.tail(a.size() - 1);
  return p;
}

/// p of a o p = r. @pre a is inside
[[nodiscard]] inline Eigen::VectorXd quotient(const Segment& r, const Segment& a) {
  const Eigen::Index n = a.size() - 1;
  Eigen::VectorXd p(a.size());
  p(0) = (a(0) * r(0) - a.tail(n).dot(r.tail(n))) / determinant(a);
  p.tail(n) = (r.tail(n) - p(0) * a.tail(n)) / a(0);
  return p;
}

/// The largest step <= 1e10 with a + step d in the cone. @pre a is inside
[[nodiscard]] inline double longest_step(const Segment& a, const Segment& d) {
  constexpr double far = 1e10;
  const Eigen::Index n = a.size() - 1;
  const double size = d.tail(n).norm();
  const double square = (d(0) - size) * (d(0) + size);
  const double half = a(0) * d(0) - a.tail(n).dot(d.tail(n));
  const double rest = determinant(a);
  // square t^2 + 2 half t + rest = 0, its smallest positive root.
  const double below = half * half - square * rest;
  double step = far;
  if (below >= 0.0) {
    const double q = -(half + std::copysign(std::sqrt(below), half));
    for (const double t : {square != 0.0 ? q / square : far, q != 0.0 ? rest / q : far})
      if (t > 0.0) step = std::min(step, t);
  }
  if (d(0) < 0.0) step = std::min(step, -a(0) / d(0));
  return step;
}

/// W of Nesterov and Todd: W^-1 x = W s, symmetric and of the cone's own automorphisms.
[[nodiscard]] inline Eigen::MatrixXd scaling(const Segment& x, const Segment& s) {
  const Eigen::Index n = x.size() - 1;
  const double of_x = std::sqrt(determinant(x));
  const double of_s = std::sqrt(determinant(s));
  const Eigen::VectorXd a = x / of_x;
  Eigen::VectorXd b = s / of_s;
  const double gamma = std::sqrt(0.5 * (1.0 + a.dot(b)));
  b.tail(n) = -b.tail(n);
  Eigen::VectorXd v = (a + b) / (2.0 * gamma);
  v(0) += 1.0;
  v /= std::sqrt(2.0 * v(0));
  Eigen::MatrixXd w = 2.0 * v * v.transpose();
  w(0, 0) -= 1.0;
  for (Eigen::Index i = 1; i <= n; ++i) w(i, i) += 1.0;
  return std::sqrt(of_x / of_s) * w;
}

}  // namespace tactile_net::lorentz
