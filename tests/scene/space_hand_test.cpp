#include "tactile_net/scene/space_hand.hpp"

#include <string>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const std::string pad_pose =
    "place = [-0.03, 0.0, 0.1]\nnormal = [-1.0, 0.0, 0.0]\ntangent = [0.0, 0.0, 1.0]\n";
const std::string contact_table = "contact = { center = [0.0, 0.001], center_deviation = 1e-4 }\n";
const std::string finger = "[[finger]]\n" + pad_pose + contact_table;

SpaceHand parsed(const std::string& toml) {
  return std::get<SpaceHand>(parse_any_hand(toml, "hand.toml", {.allow_outside = true}));
}

/// Messages, hints and lines of all that is wrong.
std::string complaints(const std::string& toml) {
  try {
    (void)parsed(toml);
  } catch (const InputError& error) {
    std::string all;
    for (const Diagnostic& one : error.diagnostics())
      all += std::to_string(one.line) + ": " + one.message + " | " + one.hint + "\n";
    return all;
  }
  return "none";
}

}  // namespace

TEST_CASE("a hand in space is read with all that it may say", "[hand]") {
  const SpaceHand hand = parsed(R"(
title = "Two"
units = "SI"
[load]
force = [0, 0, -2]
point = [0, 0.01, 0.1]
torque = [0.1, 0, 0]
[grasp]
squeeze = 5.0
friction = 0.7
friction_used = 0.9
[[finger]]
name = "left"
place = [-0.03, 0.0, 0.1]
normal = [-1.0, 0.0, 0.0]
tangent = [0.0, 0.0, 1.0]
soft = true
torsion_radius = 0.002
friction = 0.5
torque_limits = [1.0, 2.0]
joints = [{ place = [0, 0, 0], axis = [0, 1, 0] }, { place = [0, 0, 0.05], axis = [0, 1, 0] }]
contact = { normal = 3.0, tangential = [-1.0, 0.5], torsion = 0.001, center = [0.001, 0.002], normal_deviation = 0.1, tangential_deviation = 0.2, torsion_deviation = 0.3, center_deviation = 0.4 }
[[finger]]
name = "right"
place = [0.03, 0.0, 0.1]
normal = [1.0, 0.0, 0.0]
tangent = [0.0, 0.0, 1.0]
jacobian = [[1, 0], [0, 1], [0, 0], [0, 0], [0, 0], [0, 2]]
contact = { scene = "tip.toml", readings = "tip.csv", frame = 3 }
)");
  CHECK(hand.title == "Two");
  CHECK(hand.si);
  CHECK(hand.load->torque.x == 0.1);
  CHECK(hand.squeeze == 5.0);
  CHECK(hand.friction_used == 0.9);
  CHECK(hand.least == Least::torques);
  REQUIRE(hand.fingers.size() == 2);
  const SpaceHandFinger& left = hand.fingers[0];
  CHECK(left.friction == 0.5);
  CHECK(hand.fingers[1].friction == 0.7);
  CHECK(joint_count(left.finger) == 2);
  const auto& force = std::get<SpaceFingertipForce>(left.contact);
  CHECK(force.tangential_z == 0.5);
  CHECK(force.torsion == 0.001);
  CHECK(force.place.torsion_radius == 0.002);
  using enum SpaceContactValue;
  CHECK_THAT(force.deviation(normal), WithinRel(0.1, 1e-15));
  CHECK_THAT(force.deviation(tangential_z), WithinRel(0.2, 1e-15));
  CHECK_THAT(force.deviation(centre_y), WithinRel(0.4, 1e-15));
  CHECK_THAT(force.deviation(torsion), WithinRel(0.3, 1e-15));
  CHECK(hand.fingers[1].finger.jacobian(5, 1) == 2.0);
  const auto& scene = std::get<FingertipScene>(hand.fingers[1].contact);
  CHECK(scene.readings == "tip.csv");
  CHECK(scene.frame == 3);
}

TEST_CASE("without joints the least forces are asked for, and hands of the plane stay theirs",
          "[hand]") {
  CHECK(parsed(finger).least == Least::forces);
  const std::string plane =
      "[[finger]]\nbase = [0.0, 0.0]\nlinks = [1.0, 1.0]\nangles = [0.5, 0.5]\npad = { center = "
      "0.5, half_width = 0.1, side = \"left\" }\ncontact = { center = 0.0 }\n";
  CHECK(std::holds_alternative<Hand>(parse_any_hand(plane, "hand.toml")));
  CHECK_THROWS_AS(parse_hand(finger, "hand.toml"), InputError);
}

TEST_CASE("what is wrong with a hand in space is told by line, with a remedy", "[hand]") {
  const auto with = [](const std::string& more) {
    return complaints("[[finger]]\n" + pad_pose + more);
  };
  CHECK(complaints(finger) == "none");
  CHECK_THAT(complaints("[[finger]]\nplace = [0, 0, 0]\nnormal = [0, 0, 0]\ntangent = [0, 1, 0]\n" +
                        contact_table),
             ContainsSubstring("3: finger.normal must not be zero: it is a direction"));
  CHECK_THAT(complaints("[[finger]]\nplace = [0, 0]\nnormal = [1, 0, 0]\ntangent = [1, 1, 0]\n" +
                        contact_table),
             ContainsSubstring("2: finger.place must hold three numbers, X, Y and Z (got 2)") &&
                 ContainsSubstring("4: finger.tangent must be at right angles to the normal"));
  CHECK_THAT(with(contact_table + "soft = true\n"),
             ContainsSubstring("6: finger.soft needs a torsion_radius here | the torsion that"));
  CHECK_THAT(with(contact_table + "joints = [{ axis = [0, 1, 0] }]\n"),
             ContainsSubstring("place") && ContainsSubstring("a point of the axis"));
  CHECK_THAT(
      with(contact_table + "joints = [{ slides = true, axis = [0, 1, 0], place = [0, 0, 0] }]\n"),
      ContainsSubstring("does not apply to a joint that slides"));
  CHECK_THAT(with(contact_table + "jacobian = [[1.0], [1.0]]\n"),
             ContainsSubstring("must hold six rows"));
  CHECK_THAT(with(contact_table + "jacobian = [[1.0, 2.0], [1.0], [1.0], [1.0], [1.0], [1.0]]\n"),
             ContainsSubstring("must be as long as the first row"));
  CHECK_THAT(with(contact_table + "torque_limits = [1.0]\n"), ContainsSubstring("needs joints"));
  CHECK_THAT(with("contact = { normal = -1.0, tangential = [0, 0], center = [0, 0] }\n"),
             ContainsSubstring("contact.normal must be > 0"));
  CHECK_THAT(
      with("contact = { normal = 1.0, tangential = [0, 0], torsion = 0.1, center = [0, 0] }\n"),
      ContainsSubstring("does not apply to a hard finger | torsion_radius makes it a soft one"));
  CHECK_THAT(with(contact_table + "links = [0.1]\n"), ContainsSubstring("links"));
  CHECK_THAT(complaints("angles_in = \"degrees\"\n" + finger),
             ContainsSubstring("does not apply to a hand in space"));
  CHECK_THAT(complaints("[grasp]\nleast = \"torques\"\n" + finger + "name = \"b\"\n"),
             ContainsSubstring("needs the joints of every finger"));
  CHECK_THAT(complaints("[grasp]\ngrasping_force = 3.0\n" + finger),
             ContainsSubstring("give squeeze instead"));
}
