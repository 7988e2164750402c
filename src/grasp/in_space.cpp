#include "tactile_net/grasp/in_space.hpp"

#include <algorithm>
#include <array>

namespace tactile_net {
namespace {

Vector3 raised(Vector2 v) { return {v.x, v.y, 0.0}; }
/// Adding zero leaves no negative zero.
Vector2 lowered(Vector3 v) { return {0.0 + v.x, 0.0 + v.y}; }

}  // namespace

SpaceFinger in_space(const Finger& finger) {
  const FingerPose pose = pose_of(finger);
  SpaceFinger lift{.name = finger.name,
                   .place = raised(pose.pad_center),
                   .normal = raised(pose.inward),
                   .tangent = raised(pose.along)};
  for (const Vector2 joint : pose.joints) lift.joints.push_back({raised(joint), {0.0, 0.0, 1.0}});
  return lift;
}

SpaceContactPlace in_space(const ContactPlace& place) noexcept {
  return {.y = place.centre,
          .covariance = {place.deviation * place.deviation, 0.0, 0.0, 0.0},
          .planar = true};
}

SpaceFingertipForce in_space(const FingertipForce& force) noexcept {
  using enum SpaceContactValue;
  SpaceFingertipForce lift{.normal = force.normal,
                           .tangential_y = force.tangential,
                           .place = {.y = force.centre, .planar = true}};
  constexpr std::array<SpaceContactValue, 3> kinds = {normal, tangential_y, centre_y};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double value = force.covariance.values[3 * i + j];
      lift.covariance[6 * static_cast<std::size_t>(kinds[i]) + static_cast<std::size_t>(kinds[j])] =
          i == j ? std::max(value, 0.0) : value;  // rounding leaves no variance below zero
    }
  return lift;
}

SpaceLoad in_space(const ExternalLoad& load) noexcept {
  return {raised(load.force), {0.0, 0.0, load.torque}, raised(load.point)};
}

std::vector<FingerAction> in_plane(std::span<const SpaceAction> actions) {
  std::vector<FingerAction> flat;
  for (const SpaceAction& action : actions) {
    const auto& c = action.covariance;
    flat.push_back({.point = lowered(action.point),
                    .force = lowered(action.force),
                    .normal = 0.0 + action.normal,
                    .tangential = 0.0 + action.tangential_y,
                    .covariance = {{c[0], c[1], c[4], c[5]}},
                    .torques = action.torques});
  }
  return flat;
}

}  // namespace tactile_net
