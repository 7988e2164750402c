#include "tactile_net/grasp/hold.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "tactile_net/grasp/two_fingers.hpp"
#include "tests/catch.hpp"
#include "tests/grasp/hands.hpp"

using namespace tactile_net;

namespace {

HeldGrasp held(const Hand& hand, const HoldOptions& options = {}) {
  return hold(hand.fingers, hand.contacts, hand.load, options);
}

std::vector<double> torques_of(const HeldGrasp& grasp) {
  std::vector<double> torques;
  for (const FingerAction& finger : grasp.fingers)
    for (const Uncertain& torque : finger.torques) torques.push_back(torque.value);
  return torques;
}

std::vector<Complex> forces_of(const HeldGrasp& grasp) {
  std::vector<Complex> forces;
  for (const FingerAction& finger : grasp.fingers) forces.push_back(complex_of(finger.force));
  return forces;
}

}  // namespace

TEST_CASE("two fingers of two links have the torques of the thesis' system", "[grasp][property]") {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const Hand hand = random_hand(random, 2, 2);
    const double grasping_force = random.between(-1.0, 6.0);
    const TwoFingerTorques thesis =
        two_finger_torques(hand.fingers[0], hand.contacts[0].centre, hand.fingers[1],
                           hand.contacts[1].centre, hand.load, grasping_force);
    const HeldGrasp general = held(hand, {.grasping_force = grasping_force});
    const std::vector<double> torques = torques_of(general);
    const double limit = 1e-13 * (thesis.condition + general.condition) * largest(torques);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK_THAT(torques[i], WithinAbs(thesis.left[i], limit));
      CHECK_THAT(torques[2 + i], WithinAbs(thesis.right[i], limit));
    }
  }
}

TEST_CASE("any hand is in equilibrium, by the torques of its forces", "[grasp][property]") {
  Random random(2);
  for (const std::size_t fingers : {2U, 3U, 5U})
    for (const std::size_t joints : {1U, 2U, 4U})
      for (const bool squeezed : {false, true}) {
        CAPTURE(fingers, joints, squeezed);
        const Hand hand = random_hand(random, fingers, joints);
        HoldOptions options;
        if (squeezed) options.squeeze = 4.0;
        if (2 * fingers > 3 + fingers * joints + (squeezed ? 1 : 0)) {
          // More forces than torques and equations: the motors cannot tell them apart.
          CHECK_THROWS_WITH(held(hand, options), ContainsSubstring("do not determine"));
          continue;
        }
        const HeldGrasp grasp = held(hand, options);
        const std::vector<Complex> f = forces_of(grasp);
        CHECK(unbalance(hand, f) < 1e-14 * grasp.condition);
        for (std::size_t i = 0; i < fingers; ++i) {
          const Placed finger = placed(hand.fingers[i], hand.contacts[i].centre);
          CHECK(std::abs(complex_of(grasp.fingers[i].point) - finger.contact) < 1e-13);
          for (std::size_t j = 0; j < joints; ++j)
            CHECK_THAT(grasp.fingers[i].torques[j].value,
                       WithinAbs(moment(finger.contact - finger.joints[j], f[i]),
                                 1e-12 * (1.0 + 10.0 * std::abs(f[i]))));
        }
        if (!squeezed) continue;
        Complex middle = 0.0;
        for (const FingerAction& finger : grasp.fingers)
          middle += complex_of(finger.point) / static_cast<double>(fingers);
        double squeeze = 0.0;
        for (const FingerAction& finger : grasp.fingers) {
          const Complex way = middle - complex_of(finger.point);
          squeeze += (std::conj(way) * complex_of(finger.force)).real() / std::abs(way);
        }
        CHECK_THAT(squeeze, WithinAbs(4.0, 1e-13 * grasp.condition));
        CHECK_THAT(grasp.squeeze, WithinAbs(4.0, 1e-13 * grasp.condition));
      }
}

TEST_CASE("deviations of the contacts' places reach the torques by exact derivatives",
          "[grasp][property]") {
  // Against central differences of `hold` itself.
  const int kind = GENERATE(0, 1, 2, 3, 4);
  CAPTURE(kind);
  Random random(5);
  const std::size_t fingers = kind < 2 ? 2 : 3;
  Hand hand = random_hand(random, fingers, 2);
  for (ContactPlace& contact : hand.contacts) contact.centre *= 0.9;
  HoldOptions options;
  if (kind == 0) options.grasping_force = 5.0;
  if (kind == 2) options.squeeze = 5.0;
  if (kind == 4) {
    options.friction = {0.7, 0.7, 0.7};
    bool bound = false;  // until a hand is found that needs the cones
    while (!bound) {
      try {
        hand = random_hand(random, fingers, 2);
        for (ContactPlace& contact : hand.contacts) contact.centre *= 0.9;
        for (const FingerAction& finger : held(hand, options).fingers)
          bound = bound || std::abs(std::abs(finger.tangential) - 0.7 * finger.normal) < 1e-9;
      } catch (const std::domain_error&) {
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(2 * fingers);
  Eigen::MatrixXd by_places(n, static_cast<Eigen::Index>(fingers));
  std::vector<double> felt(fingers);  // variance of each normal force
  for (std::size_t k = 0; k < fingers; ++k) {
    constexpr double h = 1e-5;
    hand.contacts[k].deviation = 0.01 * static_cast<double>(k + 1);
    Hand ahead = hand;
    Hand behind = hand;
    ahead.contacts[k].centre += h;
    behind.contacts[k].centre -= h;
    const HeldGrasp a = held(ahead, options);
    const HeldGrasp b = held(behind, options);
    for (Eigen::Index i = 0; i < n; ++i)
      by_places(i, static_cast<Eigen::Index>(k)) = (torques_of(a)[static_cast<std::size_t>(i)] -
                                                    torques_of(b)[static_cast<std::size_t>(i)]) /
                                                   (2.0 * h) * hand.contacts[k].deviation;
    for (std::size_t i = 0; i < fingers; ++i) {
      const double slope = (a.fingers[i].normal - b.fingers[i].normal) / (2.0 * h);
      felt[i] += std::pow(slope * hand.contacts[k].deviation, 2);
    }
  }
  const Eigen::MatrixXd expected = by_places * by_places.transpose();
  const HeldGrasp grasp = held(hand, options);
  const double size = expected.diagonal().maxCoeff();
  REQUIRE(size > 0.0);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      CHECK_THAT(grasp.torque_covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j)),
                 WithinAbs(expected(i, j), 1e-6 * size));
  for (std::size_t i = 0; i < fingers; ++i) {
    CHECK_THAT(grasp.fingers[i].covariance.values[0],
               WithinRel(felt[i], 1e-5) || WithinAbs(0.0, 1e-15));
    CHECK_THAT(std::pow(grasp.fingers[i].torques[1].deviation, 2),
               WithinAbs(grasp.torque_covariance(2 * i + 1, 2 * i + 1), 1e-12 * size));
  }
}

TEST_CASE("no forces are found where none within the cones carry the load", "[grasp]") {
  // Two upright fingers beside each other push the object the same way, and the load pushes it too.
  Finger finger;
  finger.direction = 0.5 * std::numbers::pi;
  finger.links = {1.0, 1.0};
  finger.angles = {0.4, -0.8};
  finger.pad = {.center = 0.5, .half_width = 0.1, .side = Side::right};
  std::vector<Finger> fingers(2, finger);
  fingers[1].base = {0.0, 1.0};
  const std::vector<ContactPlace> contacts(2);
  const auto pushed = [&](double x) {
    return hold(fingers, contacts, {{x, 0.0}, 0.0, {0.0, 1.5}}, {.friction = {0.5, 0.5}});
  };
  CHECK_THROWS_AS(pushed(1.0), CannotHold);
  CHECK_NOTHROW(pushed(-1.0));
}

TEST_CASE("cones and squeezes together, or none of the load's doing", "[grasp]") {
  Random random(8);
  Hand hand = random_hand(random, 3, 2);
  hand.load = {};
  const HeldGrasp idle = held(hand, {.friction = {0.5, 0.5, 0.5}});
  for (const FingerAction& finger : idle.fingers) CHECK(length(finger.force) == 0.0);
}

TEST_CASE("what cannot be held is refused, and says why", "[grasp]") {
  Random random(6);
  const Hand good = random_hand(random, 3, 2);
  const auto refused = [&](auto change, const HoldOptions& options, const char* rule) {
    Hand hand = good;
    change(hand);
    CAPTURE(rule);
    CHECK_THROWS_WITH(held(hand, options), ContainsSubstring(rule));
  };
  const auto nothing = [](Hand&) {};
  refused([](Hand& h) { h.fingers.resize(1), h.contacts.resize(1); }, {}, "at least two fingers");
  refused([](Hand& h) { h.contacts.pop_back(); }, {}, "one contact for each finger");
  refused([](Hand& h) { h.load.force.x = NAN; }, {}, "load must be finite");
  refused([](Hand& h) { h.contacts[2].centre = 1.0; }, {}, "'finger 2'");
  refused(nothing, {.grasping_force = 1.0}, "two fingers");
  refused(nothing, {.grasping_force = 1.0, .squeeze = 1.0}, "exclude each other");
  refused(nothing, {.squeeze = NAN}, "must be finite");
  refused(nothing, {.friction = {0.5}}, "one coefficient of friction for each");
  refused(nothing, {.friction = {0.5, 0.5, 0.0}}, "friction must be > 0");
  refused(
      [](Hand& h) {
        h.fingers[1].angles[1] = std::numbers::pi;
        h.fingers[1].pad.height = h.fingers[1].pad.tilt = 0.0;
      },
      {}, "'finger 1': it is straight");
  refused(
      [](Hand& h) {
        h.fingers[2] = h.fingers[1] = h.fingers[0], h.contacts[2] = h.contacts[1] = h.contacts[0];
      },
      {}, "coincide");
}

TEST_CASE("one-jointed jaws on a line cannot squeeze along it", "[grasp]") {
  Finger jaw;
  jaw.name = "jaw";
  jaw.links = {1.0};
  jaw.angles = {0.0};
  jaw.pad = {.center = 1.0, .half_width = 0.1};
  Finger other = jaw;
  other.base.x = 4.0;
  other.direction = std::numbers::pi;
  const Hand hand{{jaw, other}, {{}, {}}, {{0.0, -1.0}, 0.0, {2.0, 0.0}}};
  CHECK_THROWS_WITH(held(hand), ContainsSubstring("do not determine the contact forces"));
  // With a squeeze the forces are fixed, though the jaws' frames, not their motors, bear it.
  const HeldGrasp grasp = held(hand, {.squeeze = 6.0});
  CHECK_THAT(grasp.fingers[0].force.x, WithinRel(3.0, 1e-13));
  CHECK_THAT(grasp.fingers[0].torques[0].value, WithinRel(0.5, 1e-13));
  CHECK_THAT(grasp.fingers[1].torques[0].value, WithinRel(-0.5, 1e-13));
}

TEST_CASE("two fingers that meet their cones at once hold by both edges", "[grasp]") {
  // Mirrored fingers carry half the load each; with one force to choose, their squeeze, either
  // edge would fix it.
  Finger left;
  left.base = {-0.03, 0.0};
  left.direction = 0.5 * std::numbers::pi;
  left.links = {0.05, 0.04};
  left.angles = {0.5, -0.5};
  left.pad = {.center = 0.02, .half_width = 0.012, .side = Side::right};
  Hand hand = mirrored({{left}, {{}}, {{0.0, -4.0}, 0.0, {0.0, 0.06}}});
  hand.fingers.insert(hand.fingers.begin(), left);
  hand.contacts.push_back({});
  const HeldGrasp grasp = held(hand, {.friction = {0.4, 0.4}});
  for (const FingerAction& finger : grasp.fingers) {
    CHECK_THAT(finger.normal, WithinRel(5.0, 1e-9));
    CHECK_THAT(std::abs(finger.tangential), WithinRel(2.0, 1e-9));
  }
}

TEST_CASE("there is no inward for a contact in the middle of all", "[grasp]") {
  Finger finger;
  finger.links = {1.0, 1.0};
  finger.angles = {0.5, -1.0};
  finger.pad = {.center = 0.5, .half_width = 0.1};
  std::vector<Finger> fingers(3, finger);
  fingers[0].base = {-2.0, 1.0};
  fingers[1].base = {2.0, -1.0};
  const std::vector<ContactPlace> contacts(3);
  CHECK_NOTHROW(hold(fingers, contacts, {}, {}));
  CHECK_THROWS_WITH(hold(fingers, contacts, {}, {.squeeze = 1.0}),
                    ContainsSubstring("middle of all contacts"));
}
