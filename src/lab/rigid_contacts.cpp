#include "tactile_net/lab/rigid_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "numeric/require.hpp"

namespace tactile_net::lab {
namespace {

/// All points of one object.
struct LineTouch {
  double curvature = 0.0;
  double normal = 0.0;                                    // [N]
  double tangential = 0.0;                                // [N]
  double moment = 0.0;                                    // of the normal forces about y = 0 [N m]
  double from = std::numeric_limits<double>::infinity();  // along
  double to = -std::numeric_limits<double>::infinity();
  double left = std::numeric_limits<double>::infinity();  // across
  double right = -std::numeric_limits<double>::infinity();

  void add(const ContactPoint& point) noexcept {
    curvature = std::max(curvature, point.curvature);
    normal += point.normal;
    tangential += point.tangential;
    moment += point.normal * point.along;
    from = std::min(from, point.along);
    to = std::max(to, point.along);
    left = std::min(left, point.across);
    right = std::max(right, point.across);
  }
};

/// Linear over the points, but nowhere narrower than `edge`, and without pulling.
LoadPatch flat(const LineTouch& touch, const ContactWidths& widths) noexcept {
  const double center = 0.5 * (touch.from + touch.to);
  const double half = 0.5 * std::max(touch.to - touch.from, widths.edge);
  const double acts = touch.moment / touch.normal;
  LoadPatch patch{.form = LoadPatch::Form::linear,
                  .center = center,
                  .half_width = half,
                  .normal = touch.normal / widths.breadth,
                  .tangential = touch.tangential / widths.breadth};
  const double off = acts - center;
  patch.moment = patch.normal * off;
  if (std::abs(off) <= half / 3.0) return patch;

  // A triangle that begins at the nearer end, its centre of gravity where the force acts.
  patch.half_width = std::max(1.5 * (half - std::abs(off)), 0.5 * widths.edge);
  patch.center = center + std::copysign(half - patch.half_width, off);
  patch.moment = patch.normal * (acts - patch.center);
  if (std::abs(acts - patch.center) > patch.half_width / 3.0) {  // at the very edge
    patch.center = acts;
    patch.moment = 0.0;
  }
  return patch;
}

LoadPatch patch_of(const LineTouch& touch, const Material& pad,
                   const ContactWidths& widths) noexcept {
  if (touch.curvature > 0.0) {
    const double nu = pad.poisson_ratio;
    const double force = touch.normal / widths.breadth;
    const double half = std::sqrt(4.0 * force * (1.0 - nu * nu) /
                                  (std::numbers::pi * pad.youngs_modulus * touch.curvature));
    if (touch.to - touch.from <= 2.0 * half)
      return {.form = LoadPatch::Form::hertz,
              .center = touch.moment / touch.normal,
              .half_width = half,
              .normal = force,
              .tangential = touch.tangential / widths.breadth};
  }
  return flat(touch, widths);
}

}  // namespace

PadFace::Touch PadFace::touched_by(const PairContact& contact, bool pad_is_second) const noexcept {
  const double side = pad_is_second ? 1.0 : -1.0;
  std::array<double, 3> from{};
  std::array<double, 3> normal{};
  std::array<double, 3> force{};
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] = contact.position[k] - origin[k];
    normal[k] = side * contact.frame[k];
    for (std::size_t row = 0; row < 3; ++row)
      force[k] += side * contact.force[row] * contact.frame[3 * row + k];
  }
  const auto along = [&](std::size_t axis, const std::array<double, 3>& vector) {
    return axes[axis] * vector[0] + axes[3 + axis] * vector[1] + axes[6 + axis] * vector[2];
  };
  return {.facing = -along(2, normal),
          .point = {.along = along(0, from),
                    .across = along(1, from),
                    .normal = -along(2, force),
                    .tangential = along(0, force),
                    .sideways = along(1, force)}};
}

ContactWidths contact_widths(const Scene& scene, double breadth, std::optional<double> edge) {
  double least = std::numeric_limits<double>::infinity();
  for (const Site& site : sites(scene.sensor)) least = std::min(least, site.depth);
  const ContactWidths widths{.breadth = breadth, .edge = edge.value_or(0.5 * least)};
  require_positive("breadth", widths.breadth);
  require_positive("edge_width", widths.edge);
  return widths;
}

ContactPatches contact_patches(std::span<const ContactPoint> points, const Material& pad,
                               const ContactWidths& widths) {
  check(pad);
  std::map<std::size_t, LineTouch> touches;
  for (const ContactPoint& point : points)
    if (point.normal > 0.0) touches[point.object].add(point);

  ContactPatches result;
  for (const auto& [object, touch] : touches) {
    result.loads.push_back(patch_of(touch, pad, widths));
    const double length = touch.right - touch.left;
    result.shortest = std::min(length, result.shortest.value_or(length));
  }
  return result;
}

}  // namespace tactile_net::lab
