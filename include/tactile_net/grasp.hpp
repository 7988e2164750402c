/// @file
/// Fingers that hold an object: joint torques for its weight, within what friction allows.
///
///     const std::vector<Finger> fingers = {left, right};
///     const ExternalLoad weight{.force = {0.0, -4.9}, .point = {0.003, 0.075}};  // [N], [m]
///     const HeldGrasp grasp = hold(fingers, contacts, weight, {.grasping_force = 20.0});
///     friction_margin(grasp.fingers[0], 0.6).verdict;
#pragma once

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/hold.hpp"
#include "tactile_net/grasp/margins.hpp"
#include "tactile_net/grasp/measured_grasp.hpp"
#include "tactile_net/grasp/space/hold_in_space.hpp"
#include "tactile_net/grasp/space/measured_space_grasp.hpp"
#include "tactile_net/grasp/two_fingers.hpp"
