// A grasp in space in process: fingertips that are skins, from readings to torques.
#include "tactile_net/lab/space_grasp.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <tuple>

#include "tactile_net/frames/frame_of.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::lab;

namespace {

SpaceHand shipped_hand(const std::string& name) {
  return std::get<SpaceHand>(read_any_hand(std::string(SCENES) + "/hands/" + name));
}

bool within(const Uncertain& found, double truth, double deviations) {
  return std::abs(found.value - truth) < deviations * found.deviation;
}

SpaceHand parsed_space_hand(const std::string& toml) {
  return std::get<SpaceHand>(parse_any_hand(toml, "hand.toml", {.allow_outside = true}));
}

std::string finger_in_space(const std::string& contact, const std::string& more = {}) {
  return "[[finger]]\nplace = [0, 0, 0]\nnormal = [1, 0, 0]\ntangent = [0, 1, 0]\n" + more +
         "contact = " + contact + "\n";
}

}  // namespace

TEST_CASE("the readings of two soft fingertips mean the forces that press on them", "[grasp]") {
  const SpaceGraspResult grasp = hold(shipped_hand("box.toml"));
  REQUIRE(grasp.measured);
  REQUIRE(grasp.failures.empty());
  const auto& [left, right] =
      std::tie(grasp.measured->grasp.fingers[0], grasp.measured->grasp.fingers[1]);
  for (const SpaceAction* action : {&left, &right}) {
    CHECK(within({action->normal, action->deviation(0)}, 3.0, 4.0));
    CHECK(within({action->tangential_y, action->deviation(1)}, -1.0, 4.0));
    CHECK(within({action->tangential_z, action->deviation(2)}, 0.0, 4.0));
    // Of a Hertz circle in full spin.
    CHECK_THAT(action->torsion_radius.value(),
               WithinRel(3.0 * std::numbers::pi * 5e-3 / 16.0, 0.03));
  }
  CHECK(within({left.torsion, left.deviation(3)}, 5e-3, 4.0));
  CHECK(within({right.torsion, right.deviation(3)}, -5e-3, 4.0));
  // Half the weight and the squeeze, by the lever from the lower joint.
  CHECK(within(left.torques[1], 3.0 * 0.1 - 1.0 * 0.03, 4.0));
  CHECK(within(right.torques[1], -3.0 * 0.1 + 1.0 * 0.03, 4.0));
  CHECK(grasp.measured->balanced == true);
  CHECK(grasp.measured->internal.count() == 2);
  REQUIRE(grasp.held);
  CHECK(grasp.held->internal.without_torque == std::size_t{0});
}

TEST_CASE("hard fingers leave the box free to turn, and say so", "[grasp]") {
  SpaceHand hand = shipped_hand("box.toml");
  for (SpaceHandFinger& one : hand.fingers) one.soft = false;
  const SpaceGraspResult grasp = hold(hand);
  CHECK(!grasp.held);
  REQUIRE(grasp.refusal);
  REQUIRE(grasp.refusal->motion);
  const Screw screw = screw_of(*grasp.refusal->motion, grasp.refusal->size);
  CHECK_THAT(std::abs(screw.direction.x), WithinAbs(1.0, 1e-3));
  for (const SpaceFingertip& tip : grasp.tips) CHECK(tip.torsion_left_out);
  // And what they felt of it is no longer balanced.
  CHECK(grasp.measured->balanced == false);
}

TEST_CASE("a grip that slips is refused with the squeeze that it asks for", "[grasp]") {
  SpaceHand hand = shipped_hand("ball.toml");
  const SpaceGraspResult least = hold(hand);
  REQUIRE(least.held);
  hand.squeeze = 0.9 * least.held->grasp.squeeze;
  const SpaceGraspResult grasp = hold(hand);
  REQUIRE(grasp.failures.size() == 1);
  CHECK(grasp.failures[0].reason == NoHold::beyond_cones_squeezed);
  REQUIRE(grasp.refusal->least_squeeze);
  hand.squeeze = 1.0001 * *grasp.refusal->least_squeeze;
  CHECK(hold(hand).held);
  hand.squeeze = 0.9999 * *grasp.refusal->least_squeeze;
  CHECK(!hold(hand).held);
}

TEST_CASE("recorded readings of a skin press as simulated ones do", "[grasp]") {
  const std::string pad = std::string(SCENES) + "/recorded/skin-pad";
  const SpaceHand hand = parsed_space_hand(
      finger_in_space("{ scene = \"" + pad + ".toml\", readings = \"" + pad + ".csv\", frame = 3 }",
                      "soft = true\n"));
  const auto readings = [](const std::filesystem::path& file, const SkinScene& scene,
                           std::size_t frame) {
    return frames::readings_of_frame(file, scene, frame);
  };
  const SpaceGraspResult grasp = hold(hand, readings);
  const SpaceAction& action = grasp.measured->grasp.fingers[0];
  CHECK_THAT(action.normal, WithinRel(0.3272, 0.02));  // of finite elements: see docs/skins.md
  CHECK_THAT(action.torsion, WithinAbs(1.571e-4, 3.0 * action.deviation(3)));
  CHECK(grasp.tips[0].source == Fingertip::Source::readings);
  CHECK(grasp.tips[0].corners);
  // One contact is all that presses.
  REQUIRE(grasp.tips[0].patches.size() == 1);
  CHECK_THAT(grasp.tips[0].patches[0].wrench.normal.value, WithinRel(action.normal, 1e-9));
}

TEST_CASE("pads that are no skins, or that nothing presses, are refused by name", "[grasp]") {
  const std::string line = std::string(SCENES) + "/dragged.toml";
  CHECK_THROWS_WITH(hold(parsed_space_hand(finger_in_space("{ scene = \"" + line + "\" }"))),
                    ContainsSubstring("is of a line array"));
  const std::string empty = std::string(SCENES) + "/recorded/skin-pad.toml";
  CHECK_THROWS_WITH(hold(parsed_space_hand(finger_in_space("{ scene = \"" + empty + "\" }"))),
                    ContainsSubstring("nothing presses on this fingertip"));
  CHECK_THROWS_WITH(hold(parsed_space_hand(finger_in_space("{ center = [0, 0] }"))),
                    ContainsSubstring("nothing to compute"));
  const std::string pressure = std::string(SCENES) + "/skins/pressure-pad.toml";
  CHECK_THROWS_WITH(
      hold(parsed_space_hand(finger_in_space("{ scene = \"" + pressure + "\" }", "soft = true\n"))),
      ContainsSubstring("give torsion_radius"));
}
