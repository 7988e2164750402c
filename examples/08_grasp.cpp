// Two fingers hold an object: joint torques for its weight, within what friction allows.
// Prints for each finger its force, how much of its friction that uses, and its torques.
#include <cstdio>
#include <numbers>
#include <tactile_net/grasp.hpp>
#include <vector>

using namespace tactile_net;

int main() {
  constexpr double degree = std::numbers::pi / 180.0;
  const Pad right_facing{
      .center = 0.025, .height = 0.005, .half_width = 0.012, .side = Side::right};
  const Finger left{.name = "left",
                    .base = {-0.02, 0.0},
                    .direction = 90 * degree,
                    .links = {0.05, 0.04},
                    .angles = {35 * degree, -50 * degree},
                    .pad = right_facing};
  Finger right = left;  // its mirror image
  right.name = "right";
  right.base = {0.02, 0.0};
  right.angles = {-35 * degree, 50 * degree};
  right.pad.side = Side::left;

  const std::vector<Finger> fingers = {left, right};
  const std::vector<ContactPlace> contacts = {{.centre = 0.001, .deviation = 0.2e-3},
                                              {.centre = 0.002, .deviation = 0.2e-3}};
  const ExternalLoad half_a_kilogram{.force = {0.0, -4.9}, .point = {0.003, 0.075}};  // [N], [m]
  const double friction = 0.6;
  const HeldGrasp grasp = hold(fingers, contacts, half_a_kilogram,
                               {.grasping_force = 20.0, .friction = {friction, friction}});

  bool sound = true;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const FingerAction& action = grasp.fingers[i];
    const FrictionMargin margin = friction_margin(action, friction);
    std::printf("%-5s presses with %.2f N, drags with %.2f N: %s, %.0f %% of its friction; ",
                fingers[i].name.c_str(), action.normal, action.tangential, name(margin.verdict),
                100.0 * margin.used);
    std::printf("torques %.3f +- %.3f and %.3f +- %.3f Nm\n", action.torques[0].value,
                action.torques[0].deviation, action.torques[1].value, action.torques[1].deviation);
    sound = sound && margin.verdict == ContactVerdict::holds;
  }
  return sound ? 0 : 1;
}
