#include "skin/disc_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactile_net {
namespace {

using std::numbers::pi;

/// One side of a polygon, against the clock: points at the distance d from the middle, w along it.
struct Side {
  Side(const SurfaceVector& p, const SurfaceVector& q) noexcept {
    const double length = std::hypot(q.y - p.y, q.z - p.z);
    if (length == 0.0) return;
    along = {(q.y - p.y) / length, (q.z - p.z) / length};
    d = p.y * along.z - p.z * along.y;
    from = p.y * along.y + p.z * along.z;
    to = q.y * along.y + q.z * along.z;
    const double half_chord = std::abs(d) < 1.0 ? std::sqrt((1.0 - d) * (1.0 + d)) : 0.0;
    enters = std::clamp(from, -half_chord, half_chord);
    leaves = std::clamp(to, -half_chord, half_chord);
  }
  [[nodiscard]] bool crosses() const noexcept { return enters < leaves; }

  SurfaceVector along{};
  double d = 0.0;  // > 0: the middle lies on the side's left, as the polygon does
  double from = 0.0;
  double to = 0.0;
  double enters = 0.0;  // where it is inside the disc
  double leaves = 0.0;
};

/// Sides from one corner to the next.
double sum_over(std::span<const SurfaceVector> corners, const auto& side_integral) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += side_integral(Side(corners[i], corners[(i + 1) % corners.size()]));
  return sum;
}

/// M(s) = integral_0^s s f(s) ds of the traction f of force 2 pi M(1), over the angle at which a
/// side is seen from the middle: from the foot of the perpendicular, d > 0 away, to w.
double swept(DiscProfile profile, double d, double w) noexcept {
  const double square = d * d + w * w;
  const double k = std::sqrt(std::max(0.0, 1.0 - square));  // sqrt(1 - s^2)
  const double angle = std::atan2(w, d);
  const double root = std::atan2(w, d * k) - d * std::atan2(w, k);  // of sqrt(1 - s^2)
  switch (profile) {
    case DiscProfile::sphere: {  // M = (1 - k^3) / 3
      const double chord = (1.0 - d) * (1.0 + d);
      return (angle - root + 0.5 * d * (w * k + chord * std::atan2(w, k))) / 3.0;
    }
    case DiscProfile::punch:  // M = 1 - k
      return angle - root;
    case DiscProfile::cone: {  // M = (s^2 arccosh(1 / s) + 1 - k) / 2
      const double steep = square > 0.0 ? w * std::asinh(k / std::sqrt(square)) : 0.0;
      return 0.5 * (d * (steep + std::atan2(w, k) - d * std::atan2(w, d * k)) + angle - root);
    }
  }
  return 0.0;
}

/// M(1).
double whole(DiscProfile profile) noexcept {
  switch (profile) {
    case DiscProfile::sphere:
      return 1.0 / 3.0;
    case DiscProfile::punch:
      return 1.0;
    case DiscProfile::cone:
      return 0.5;
  }
  return 0.0;
}

/// Of k^3 along a side.
double dome_along(const Side& side) noexcept {
  const double chord = (1.0 - side.d) * (1.0 + side.d);
  const auto upto = [&](double w) {
    const double k = std::sqrt(std::max(0.0, chord - w * w));
    return 0.25 * w * k * k * k + 0.375 * chord * (w * k + chord * std::atan2(w, k));
  };
  return upto(side.leaves) - upto(side.enters);
}

}  // namespace

double force_share(DiscProfile profile, std::span<const SurfaceVector> corners) noexcept {
  bool crosses = false;
  bool around = true;
  const double sum = sum_over(corners, [&](const Side& side) {
    crosses = crosses || side.crosses();
    around = around && side.d > 0.0;
    const double d = std::abs(side.d);
    if (d == 0.0) return 0.0;
    double own = 0.0;
    if (side.crosses()) own += swept(profile, d, side.leaves) - swept(profile, d, side.enters);
    // Beyond the rim nothing is added but the angle.
    const auto angle = [&](double w) { return std::atan2(w, d); };
    own += whole(profile) * (angle(side.to) - angle(side.from) -
                             (side.crosses() ? angle(side.leaves) - angle(side.enters) : 0.0));
    return side.d > 0.0 ? own : -own;
  });
  if (!crosses) return around ? 1.0 : 0.0;
  return sum / (2.0 * pi * whole(profile));
}

SurfaceVector dome_moment(std::span<const SurfaceVector> corners) noexcept {
  // Green's theorem: u k and v k are the derivatives of -k^3 / 3.
  constexpr double scale = 0.5 / pi;
  return {-sum_over(corners, [](const Side& s) { return s.along.z * dome_along(s); }) * scale,
          sum_over(corners, [](const Side& s) { return s.along.y * dome_along(s); }) * scale};
}

}  // namespace tactile_net
