#include "tactile_net/grasp/two_fingers.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "tests/catch.hpp"
#include "tests/grasp/hands.hpp"

using namespace tactile_net;

namespace {

TwoFingerTorques solve(const Hand& hand, double grasping_force) {
  return two_finger_torques(hand.fingers[0], hand.contacts[0].centre, hand.fingers[1],
                            hand.contacts[1].centre, hand.load, grasping_force);
}

/// The force whose moments about the two joints are the torques.
Complex force_of(const Placed& finger, const std::array<double, 2>& torques) {
  const Complex a = finger.contact - finger.joints[0];
  const Complex b = finger.contact - finger.joints[1];
  return (b * torques[0] - a * torques[1]) / moment(a, b);
}

std::vector<Complex> forces_of(const Hand& hand, const TwoFingerTorques& torques) {
  return {force_of(placed(hand.fingers[0], hand.contacts[0].centre), torques.left),
          force_of(placed(hand.fingers[1], hand.contacts[1].centre), torques.right)};
}

std::array<double, 4> all(const TwoFingerTorques& torques) {
  return {torques.left[0], torques.left[1], torques.right[0], torques.right[1]};
}

}  // namespace

TEST_CASE("the torques hold the object in equilibrium and squeeze as asked", "[grasp][property]") {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const Hand hand = random_hand(random, 2, 2);
    const double squeeze = random.between(-2.0, 10.0);
    const TwoFingerTorques torques = solve(hand, squeeze);
    const std::vector<Complex> f = forces_of(hand, torques);
    CHECK(unbalance(hand, f) < 1e-13 * torques.condition);
    // The definition 6.9: projections on the line of contacts, the load's taken off.
    const Complex o_l = placed(hand.fingers[0], hand.contacts[0].centre).contact;
    const Complex o_r = placed(hand.fingers[1], hand.contacts[1].centre).contact;
    const Complex e = (o_r - o_l) / std::abs(o_r - o_l);
    const auto along = [&](Complex v) { return (std::conj(e) * v).real(); };
    const double f_g = along(f[0]) - along(f[1]) - std::abs(along(complex_of(hand.load.force)));
    CHECK_THAT(f_g, WithinAbs(squeeze, 1e-12 * torques.condition * (std::abs(f[0]) + 1.0)));
    // The finger that the load presses less pushes with half of it.
    CHECK_THAT(std::fmin(along(f[0]), -along(f[1])),
               WithinAbs(0.5 * squeeze, 1e-12 * torques.condition * (std::abs(f[0]) + 1.0)));
  }
}

TEST_CASE("the printed equations hold the opposite torque, and scale the grasping force",
          "[grasp][erratum]") {
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Hand hand = random_hand(random, 2, 2);
    const TwoFingerTorques torques = solve(hand, 3.0);
    const std::vector<Complex> f = forces_of(hand, torques);
    const Complex o_l = placed(hand.fingers[0], hand.contacts[0].centre).contact;
    const Complex o_r = placed(hand.fingers[1], hand.contacts[1].centre).contact;
    const Complex f_e = complex_of(hand.load.force);
    const double limit = 1e-11 * torques.condition * (std::abs(f[0]) + std::abs(f[1]) + 1.0);
    // 6.8 with r_rl from O_r to O_l and r_e from B to O_l: true for -t_e.
    const double printed =
        moment(o_l - o_r, f[1]) + moment(o_l - complex_of(hand.load.point), f_e) + hand.load.torque;
    CHECK_THAT(printed, WithinAbs(2.0 * hand.load.torque, limit));
    // 6.10, with r_rl as it is.
    const auto along = [&](Complex v) { return (std::conj(o_l - o_r) * v).real(); };
    CHECK_THAT(-along(f[0]) + along(f[1]) - std::abs(along(f_e)),
               WithinAbs(3.0 * std::abs(o_l - o_r), limit));
  }
}

TEST_CASE("joints do the work that the object's motion takes from the load", "[grasp][property]") {
  // The object moves as a rigid body, and the contact points with it; how the joints follow comes
  // from differences of the kinematics, not from a Jacobian.
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    CAPTURE(trial);
    const Hand hand = random_hand(random, 2, 2);
    const TwoFingerTorques torques = solve(hand, random.between(0.0, 5.0));
    const Complex shift{random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    const double turn = random.between(-1.0, 1.0);
    const auto velocity = [&](Complex point) { return shift + turn * Complex{0.0, 1.0} * point; };
    double work = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double y = hand.contacts[i].centre;
      const auto by_joint = [&](std::size_t joint) {
        constexpr double h = 1e-5;
        Finger ahead = hand.fingers[i];
        Finger behind = hand.fingers[i];
        ahead.angles[joint] += h;
        behind.angles[joint] -= h;
        return (placed(ahead, y).contact - placed(behind, y).contact) / (2.0 * h);
      };
      const Complex a = by_joint(0);
      const Complex b = by_joint(1);
      const Complex v = velocity(placed(hand.fingers[i], y).contact);
      const std::array<double, 2>& tau = i == 0 ? torques.left : torques.right;
      const double rate_a = moment(v, b) / moment(a, b);
      const double rate_b = moment(a, v) / moment(a, b);
      work += tau[0] * rate_a + tau[1] * rate_b;
      size += std::abs(tau[0] * rate_a) + std::abs(tau[1] * rate_b);
    }
    const Complex at_load = velocity(complex_of(hand.load.point));
    work += (std::conj(complex_of(hand.load.force)) * at_load).real() + hand.load.torque * turn;
    CHECK(std::abs(work) < 1e-7 * (size + 1.0));
  }
}

TEST_CASE("torques do not depend on the palm's frame, and mirror with the hand",
          "[grasp][property]") {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    CAPTURE(trial);
    const Hand hand = random_hand(random, 2, 2);
    const auto one = all(solve(hand, 3.0));
    const Hand away = moved(hand, random.between(-3.0, 3.0),
                            {random.between(-5.0, 5.0), random.between(-5.0, 5.0)});
    const auto other = all(solve(away, 3.0));
    const auto mirror = all(solve(mirrored(hand), 3.0));
    const Hand exchanged{
        {hand.fingers[1], hand.fingers[0]}, {hand.contacts[1], hand.contacts[0]}, hand.load};
    const auto crossed = all(solve(exchanged, 3.0));
    const double limit = 1e-12 * solve(hand, 3.0).condition * largest(one);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK_THAT(other[i], WithinAbs(one[i], limit));
      CHECK_THAT(mirror[i], WithinAbs(-one[i], limit));
      CHECK_THAT(crossed[(i + 2) % 4], WithinAbs(one[i], limit));
    }
  }
}

TEST_CASE("units change the torques' unit and nothing else", "[grasp][property]") {
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    CAPTURE(trial);
    const Hand hand = random_hand(random, 2, 2);
    const TwoFingerTorques one = solve(hand, 3.0);
    const TwoFingerTorques other = solve(scaled(hand, 1e-3, 1e5), 3.0e5);
    CHECK_THAT(other.condition, WithinRel(one.condition, 1e-9));
    for (std::size_t i = 0; i < 4; ++i)
      CHECK_THAT(1e-2 * all(other)[i],
                 WithinAbs(all(one)[i], 1e-12 * one.condition * largest(all(one))));
  }
}

TEST_CASE("what cannot be held so is refused, and says why", "[grasp]") {
  Random random(5);
  const Hand good = random_hand(random, 2, 2);
  const auto refused = [&](auto change, const char* rule) {
    Hand hand = good;
    change(hand);
    CAPTURE(rule);
    CHECK_THROWS_WITH(solve(hand, 1.0), ContainsSubstring(rule));
  };
  const auto straighten = [](Hand& hand, double angle) {
    hand.fingers[1].angles[1] = angle;
    hand.fingers[1].pad.height = 0.0;
    hand.fingers[1].pad.tilt = 0.0;
  };
  refused([&](Hand& h) { straighten(h, 0.0); }, "'finger 1': it is straight");
  refused([&](Hand& h) { straighten(h, std::numbers::pi); }, "'finger 1': it is straight");
  refused([](Hand& h) { h.contacts[0].centre = 0.41; }, "'finger 0': the contact must lie on");
  refused([](Hand& h) { h.fingers[1] = h.fingers[0], h.contacts[1] = h.contacts[0]; },
          "contacts coincide");
  refused([](Hand& h) { h.fingers[0].links.push_back(1.0); }, "two links");
  refused([](Hand& h) { h.load.torque = NAN; }, "must be finite");
}

TEST_CASE("a nearly straight finger shows in the condition number", "[grasp]") {
  Random random(6);
  Hand hand = random_hand(random, 2, 2);
  hand.fingers[0].pad.height = hand.fingers[0].pad.tilt = 0.0;
  double last = 0.0;
  for (const double angle : {1e-2, 1e-4, 1e-6}) {
    hand.fingers[0].angles[1] = angle;
    const double condition = solve(hand, 1.0).condition;
    CHECK(condition > 30.0 * last);
    last = condition;
  }
}
