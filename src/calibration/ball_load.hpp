/// @file
/// A round traction on a sphere by its spherical harmonics: what `indenter_transform` is on a
/// plane. Private.
///
/// A traction on a disc of radius a, of which places count by their chord s a from its middle, is
/// the Abel integral of a function w, as on a plane: of a ball 3/2 (1 - s^2), of a punch 1, of a
/// cone 2 (1 - s). Legendre's polynomials are integrals of the same kind (Mehler and Dirichlet), so
/// the share of degree n of a normal traction and of one that drags along the arcs through the
/// middle is
///
///     integral_0^1 w(s) cos((n + 1/2) t) / cos(t/2) ds,    sin(t/2) = s a / (2 R)
///
/// for the former, and that minus its slope by log a over 2 n (n + 1) for the latter.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/wave_nodes.hpp"
#include "tactile_net/elasticity/space/disc.hpp"

namespace tactile_net {

/// The shares of one disc, degree after degree from 0 on.
class BallLoad {
 public:
  struct Share {
    double normal = 1.0, drag = 1.0;
    double normal_slope = 0.0, drag_slope = 0.0;  ///< by log a
  };

  /// @param contact  a over the sphere's radius, > 0; at most 1.9 counts
  /// @param degrees  how many will be asked for
  BallLoad(DiscProfile profile, double contact, std::size_t degrees) {
    const double half = 0.5 * std::min(contact, 1.9);
    const double most = 2.0 * std::asin(half) * static_cast<double>(degrees);
    const double panels = std::clamp(std::ceil(most / 26.0), 1.0, 100.0);
    for (double panel = 0.0; panel < panels; ++panel)
      each_point(panel / panels, 1.0 / panels, [&](double s, double share) {
        const double weight = profile == DiscProfile::sphere  ? 1.5 * (1.0 - s * s)
                              : profile == DiscProfile::punch ? 1.0
                                                              : 2.0 * (1.0 - s);
        const double sine = s * half;
        const double cosine = std::sqrt(1.0 - sine * sine);
        const double turn = 2.0 * sine * cosine;  // sin t
        points_.push_back(
            {share * weight / cosine, sine / cosine, cosine, sine, 1.0 - 2.0 * sine * sine, turn});
      });
  }

  [[nodiscard]] Share next() noexcept {
    const double n = degree_++;
    const double m = n + 0.5;
    double value = 0.0;
    double slope = 0.0;
    double bend = 0.0;
    for (Point& at : points_) {
      // g = cos m t / cos(t/2), its slopes by t, and d / d log a = 2 tan(t/2) d / dt.
      const double first = -m * at.sine + 0.5 * at.tangent * at.cosine;
      const double second =
          (0.25 + 0.5 * at.tangent * at.tangent - m * m) * at.cosine - m * at.tangent * at.sine;
      value += at.weight * at.cosine;
      slope += at.weight * 2.0 * at.tangent * first;
      bend += at.weight * 2.0 * at.tangent *
              ((1.0 + at.tangent * at.tangent) * first + 2.0 * at.tangent * second);
      const double cosine = at.cosine * at.step_cosine - at.sine * at.step_sine;
      at.sine = at.sine * at.step_cosine + at.cosine * at.step_sine;
      at.cosine = cosine;
    }
    const double turned = n > 0.0 ? 1.0 / (2.0 * n * (n + 1.0)) : 0.0;
    return {value, value - turned * slope, slope, slope - turned * bend};
  }

 private:
  struct Point {
    double weight, tangent;         // of t/2
    double cosine, sine;            // of (n + 1/2) t
    double step_cosine, step_sine;  // of t
  };
  std::vector<Point> points_{};
  double degree_ = 0.0;
};

}  // namespace tactile_net
