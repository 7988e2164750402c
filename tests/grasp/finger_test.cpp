#include "tactile_net/grasp/finger.hpp"

#include <limits>
#include <numbers>

#include "tests/catch.hpp"
#include "tests/grasp/hands.hpp"

using namespace tactile_net;

namespace {

Finger upright() {
  Finger finger;
  finger.name = "index";
  finger.direction = 0.5 * std::numbers::pi;
  finger.links = {2.0, 1.0};
  finger.angles = {0.0, 0.0};
  finger.pad = {.center = 0.6, .height = 0.1, .half_width = 0.3};
  return finger;
}

}  // namespace

TEST_CASE("an upright finger's left pad looks to the left, its y to the tip", "[grasp]") {
  Finger finger = upright();
  FingerPose pose = pose_of(finger);
  CHECK_THAT(pose.tip.y, WithinAbs(3.0, 1e-15));
  CHECK_THAT(pose.pad_center.x, WithinAbs(-0.1, 1e-15));
  CHECK_THAT(pose.pad_center.y, WithinAbs(2.6, 1e-15));
  CHECK_THAT(pose.inward.x, WithinAbs(1.0, 1e-15));
  CHECK_THAT(pose.along.y, WithinAbs(1.0, 1e-15));
  finger.pad.side = Side::right;
  finger.pad.reversed = true;
  pose = pose_of(finger);
  CHECK_THAT(pose.pad_center.x, WithinAbs(0.1, 1e-15));
  CHECK_THAT(pose.inward.x, WithinAbs(-1.0, 1e-15));
  CHECK_THAT(pose.along.y, WithinAbs(-1.0, 1e-15));
}

TEST_CASE("poses agree with rotations of the complex plane", "[grasp][property]") {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Hand hand = random_hand(random, 1, 1 + static_cast<std::size_t>(trial % 5));
    const Finger& finger = hand.fingers.front();
    const FingerPose pose = pose_of(finger);
    const double y = hand.contacts.front().centre;
    const Placed other = placed(finger, y);
    CHECK(std::abs(complex_of(contact_point(pose, y)) - other.contact) < 1e-13);
    for (std::size_t j = 0; j < pose.joints.size(); ++j)
      CHECK(std::abs(complex_of(pose.joints[j]) - other.joints[j]) < 1e-13);
    CHECK_THAT(dot(pose.along, pose.inward), WithinAbs(0.0, 1e-15));
    // The pad faces away from its link: inward points to the link's axis from the pad's side.
    const Vector2 link = pose.tip - pose.joints.back();
    const double side = finger.pad.side == Side::left ? 1.0 : -1.0;
    CHECK(side * cross(link, -pose.inward) > 0.0);
  }
}

TEST_CASE("a finger is straight where its joints and the contact are on one line", "[grasp]") {
  Finger finger = upright();
  finger.pad.height = 0.0;
  const auto straight = [&] {
    const FingerPose pose = pose_of(finger);
    return is_straight(pose, contact_point(pose, 0.1));
  };
  CHECK(straight());
  finger.angles[1] = std::numbers::pi;
  CHECK(straight());
  finger.angles[1] = 1e-6;
  CHECK_FALSE(straight());
  finger.links = {2.0};
  finger.angles = {0.0};
  CHECK_FALSE(straight());  // one joint turns whatever its angle
}

TEST_CASE("a finger that cannot be is refused by name", "[grasp]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto change, const char* rule) {
    Finger finger = upright();
    change(finger);
    CAPTURE(rule);
    CHECK_THROWS_WITH(pose_of(finger), ContainsSubstring("'index'") && ContainsSubstring(rule));
  };
  refused([](Finger& f) { f.links.clear(); }, "at least one link");
  refused([](Finger& f) { f.angles.push_back(0.0); }, "one angle for each link");
  refused([](Finger& f) { f.links[1] = 0.0; }, "length must be > 0");
  refused([](Finger& f) { f.links[1] = nan; }, "length must be > 0");
  refused([](Finger& f) { f.angles[0] = nan; }, "angles must be finite");
  refused([](Finger& f) { f.direction = nan; }, "angles must be finite");
  refused([](Finger& f) { f.base.y = nan; }, "base must be finite");
  refused([](Finger& f) { f.pad.tilt = nan; }, "pad's place must be finite");
  refused([](Finger& f) { f.pad.half_width = 0.0; }, "half width must be > 0");
}

TEST_CASE("a fingertip that does not press, or beside its pad, is refused by name", "[grasp]") {
  const Finger finger = upright();
  CHECK_NOTHROW(check(finger, FingertipForce{1.0, -2.0, 0.3}));
  CHECK_THROWS_WITH(check(finger, FingertipForce{0.0, 1.0, 0.0}),
                    ContainsSubstring("'index'") && ContainsSubstring("must be > 0"));
  CHECK_THROWS_WITH(check(finger, FingertipForce{NAN, 1.0, 0.0}), ContainsSubstring("> 0"));
  CHECK_THROWS_WITH(check(finger, FingertipForce{1.0, NAN, 0.0}), ContainsSubstring("tangential"));
  CHECK_THROWS_WITH(check(finger, FingertipForce{1.0, 1.0, -0.31}),
                    ContainsSubstring("on the fingertip"));
  CHECK_THROWS_WITH(check(finger, FingertipForce{1.0, 1.0, 0.0, {NAN}}),
                    ContainsSubstring("covariance"));
  CHECK_THROWS_WITH(check(finger, ContactPlace{NAN, 0.0}), ContainsSubstring("on the fingertip"));
  CHECK_THROWS_WITH(check(finger, ContactPlace{0.0, -1.0}), ContainsSubstring("deviation"));
  CHECK_THROWS_WITH(fingertip_force(UncertainResultant{}, 0.0), ContainsSubstring("breadth"));
  CHECK_THROWS_WITH(fingertip_force(UncertainResultant{}, 1.0), ContainsSubstring("must be > 0"));
}
