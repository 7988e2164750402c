#include "tactile_net/grasp/hold.hpp"

#include <stdexcept>
#include <utility>

#include "tactile_net/grasp/in_space.hpp"

namespace tactile_net {

HeldGrasp hold(std::span<const Finger> fingers, std::span<const ContactPlace> contacts,
               const ExternalLoad& load, const HoldOptions& options) {
  if (contacts.size() != fingers.size())
    throw std::invalid_argument("there must be one contact for each finger");
  std::vector<SpaceFinger> lifted;
  std::vector<SpaceContactPlace> places;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const FingerPose pose = pose_of(fingers[i]);
    check(fingers[i], contacts[i]);
    check_bent(fingers[i], pose, contact_point(pose, contacts[i].centre));
    lifted.push_back(in_space(fingers[i]));
    places.push_back(in_space(contacts[i]));
  }
  HeldSpaceGrasp grasp = hold(lifted, places, in_space(load), options);
  return {.fingers = in_plane(grasp.fingers),
          .torque_covariance = std::move(grasp.torque_covariance),
          .squeeze = grasp.squeeze,
          .condition = grasp.condition.value()};
}

}  // namespace tactile_net
