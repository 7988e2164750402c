/// @file
/// A hand of the plane as a hand in space: the plane's X and Y are the first two axes, and all
/// joints turn about the third. What a grasp is, is worked out in space alone.
///
///     std::vector<SpaceFinger> fingers;
///     for (const Finger& finger : plane) fingers.push_back(in_space(finger));
///     internal_forces(fingers, measured_grasp(fingers, forces, in_space(load)).fingers);
#pragma once

#include <span>
#include <vector>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"
#include "tactile_net/grasp/space/space_action.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"
#include "tactile_net/grasp/space/space_finger.hpp"

namespace tactile_net {

/// The finger in space.
/// @throw std::invalid_argument  the finger is wrong: see `check`
[[nodiscard]] SpaceFinger in_space(const Finger& finger);
/// The place as a `planar` contact in space: it bears no force across the plane.
[[nodiscard]] SpaceContactPlace in_space(const ContactPlace& place) noexcept;
[[nodiscard]] SpaceFingertipForce in_space(const FingertipForce& force) noexcept;
[[nodiscard]] SpaceLoad in_space(const ExternalLoad& load) noexcept;

/// Actions of fingers in the plane X, Y, as actions in that plane.
[[nodiscard]] std::vector<FingerAction> in_plane(std::span<const SpaceAction> actions);

}  // namespace tactile_net
