#include "tactile_net/grasp/space/hold_in_space.hpp"

#include <cmath>

#include "tactile_net/grasp/hold.hpp"
#include "tests/catch.hpp"
#include "tests/grasp/space/embedded_hand.hpp"
#include "tests/grasp/space/space_hands.hpp"

using namespace tactile_net;

namespace {

HeldSpaceGrasp held(const SpaceHand& hand, const HoldOptions& options) {
  return hold(hand.fingers, hand.places(), hand.load, options);
}

std::vector<double> torques_of(const HeldSpaceGrasp& grasp) {
  std::vector<double> torques;
  for (const SpaceAction& finger : grasp.fingers)
    for (const Uncertain& torque : finger.torques) torques.push_back(torque.value);
  return torques;
}

double size_of(const std::vector<SpaceAction>& actions) {
  double size = 0.0;
  for (const SpaceAction& action : actions) size = std::fmax(size, length(action.force));
  return size;
}

/// A random force of the finger on the object that is inside its cone, or on it.
Eigen::Matrix<double, 6, 1> random_wrench(Random& random, const SpaceFinger& finger,
                                          const SpaceContactPlace& place, double friction) {
  const PadFrame pad = pad_frame(finger);
  const Vector3 point = contact_point(pad, place.y, place.z);
  Eigen::Vector3d drag(random.normal(), random.normal(),
                       place.torsion_radius ? random.normal() : 0.0);
  drag *= friction * (random.sign() > 0.0 ? 1.0 : random.between(0.0, 1.0)) / drag.norm();
  const Vector3 force = -(pad.x + drag.x() * pad.y + drag.y() * pad.z);
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << column(force),
      column(cross(point, force) - drag.z() * place.torsion_radius.value_or(0.0) * pad.x);
  return wrench;
}

/// @param limit, of_deviations  over the largest torque, and over its largest deviation
void check_same_torques(const HeldGrasp& flat, const HeldSpaceGrasp& grasp, double limit,
                        double of_deviations) {
  double size = 0.0;
  double deviation = 0.0;
  for (const FingerAction& action : flat.fingers)
    for (const Uncertain& torque : action.torques) {
      size = std::fmax(size, std::abs(torque.value));
      deviation = std::fmax(deviation, torque.deviation);
    }
  for (std::size_t f = 0; f < flat.fingers.size(); ++f)
    for (std::size_t j = 0; j < flat.fingers[f].torques.size(); ++j) {
      const Uncertain& expected = flat.fingers[f].torques[j];
      const Uncertain& torque = grasp.fingers[f].torques[j];
      CHECK_THAT(torque.value, WithinAbs(expected.value, limit * size));
      CHECK_THAT(torque.deviation, WithinAbs(expected.deviation, of_deviations * deviation));
    }
}

const HoldOptions least_forces{.friction = {0.5, 0.5}, .least = Least::forces};

}  // namespace

TEST_CASE("forces that hold are in equilibrium, inside the cones, and none are less",
          "[grasp][property]") {
  const unsigned seed = GENERATE(range(0u, 30u));
  CAPTURE(seed);
  Random random(seed);
  const std::size_t fingers = 3 + seed % 2;
  const SpaceHand hand = random_space_hand(random, fingers, 3, seed % 3);
  const HoldOptions options{.friction = std::vector<double>(fingers, 0.8)};
  const HeldSpaceGrasp grasp = held(hand, options);
  const double size = size_of(grasp.fingers);
  CHECK(sum_of(grasp.fingers, hand.load).norm() < 1e-11 * size);
  CHECK(grasp.residual < 1e-12);
  CHECK(grasp.optimality < 1e-12);
  for (const SpaceAction& action : grasp.fingers)
    CHECK(friction_margin(action, 0.8).distance.value > -1e-11 * size);

  // The condition for a minimum over a convex set: tau*.(tau - tau*) >= 0 for all that may be.
  const std::vector<double> least = torques_of(grasp);
  for (const double squeeze : {1.02, 1.1, 1.5, 3.0})
    for (const Least other : {Least::forces, Least::torques}) {
      HoldOptions more = options;
      more.squeeze = squeeze * grasp.squeeze;
      more.least = other;
      const std::vector<double> torques = torques_of(held(hand, more));
      double change = 0.0;
      double scale = 0.0;
      for (std::size_t i = 0; i < least.size(); ++i) {
        change += least[i] * (torques[i] - least[i]);
        scale += least[i] * least[i];
      }
      CHECK(change > -1e-10 * scale);
    }
}

TEST_CASE("two fingers that squeeze a weight press with it over twice the friction", "[grasp]") {
  const double weight = 3.0;
  const SpaceHand hand = two_opposed(0.0, {.force = {0.0, 0.0, -weight}});
  const HeldSpaceGrasp grasp = held(hand, least_forces);
  for (const SpaceAction& action : grasp.fingers) {
    CHECK_THAT(action.normal, WithinRel(weight / (2.0 * 0.5), 1e-12));
    CHECK_THAT(action.tangential_y, WithinRel(-0.5 * weight, 1e-12));  // of the object on the pad
    CHECK_THAT(action.tangential_z, WithinAbs(0.0, 1e-12));
  }
  CHECK_THAT(grasp.squeeze, WithinRel(2.0 * weight, 1e-12));
}

TEST_CASE("soft fingers bear a torque about the line between them, up to their ellipsoid",
          "[grasp]") {
  // Each bears half the torque, of at most mu N r.
  const double radius = 0.1;
  HoldOptions options{.squeeze = 8.0, .friction = {0.5, 0.5}, .least = Least::forces};
  const double most = 2.0 * 0.5 * 4.0 * radius;
  const HeldSpaceGrasp grasp = held(two_opposed(radius, {.torque = {0.999 * most, 0, 0}}), options);
  CHECK_THAT(grasp.fingers[0].moment.x, WithinRel(-0.4995 * most, 1e-9));
  CHECK_THAT(friction_margin(grasp.fingers[0], 0.5).used, WithinRel(0.999, 1e-9));
  try {
    (void)held(two_opposed(radius, {.torque = {1.001 * most, 0, 0}}), options);
    FAIL("held");
  } catch (const CannotHoldInSpace& error) {
    CHECK(error.reason() == NoHold::beyond_cones_squeezed);
    CHECK_THAT(error.least_squeeze().value(), WithinRel(8.0 * 1.001, 1e-8));
  }
  // A drag leaves less of it: (F_t / mu N)^2 + (T / mu N r)^2 = 1.
  const double half = 1.2;  // of 2 N that each may drag
  const SpaceLoad both{.force = {0.0, 0.0, -2.0 * half},
                       .torque = {0.9999 * most * std::sqrt(1.0 - half * half / 4.0), 0, 0}};
  CHECK_THAT(friction_margin(held(two_opposed(radius, both), options).fingers[1], 0.5).used,
             WithinAbs(1.0, 1e-4));
}

TEST_CASE("three fingers around a ball bear its weight alike", "[grasp]") {
  SpaceHand hand{.load = {.force = {0.0, 0.0, -3.0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / 3.0;
    const Vector3 out{std::cos(angle), std::sin(angle), 0.0};
    hand.fingers.push_back(
        {.name = std::to_string(i), .place = out, .normal = out, .tangent = {0.0, 0.0, 1.0}});
    hand.forces.push_back({.normal = 1.0});
  }
  const HeldSpaceGrasp grasp = held(hand, {.friction = {0.5, 0.5, 0.5}, .least = Least::forces});
  for (const SpaceAction& action : grasp.fingers) {
    CHECK_THAT(action.normal, WithinRel(2.0, 1e-12));
    CHECK_THAT(action.tangential_y, WithinRel(-1.0, 1e-12));
  }
  const InternalForces internal = internal_forces(hand.fingers, grasp.fingers);
  for (const InternalForces::Pair& pair : internal.pairs)
    CHECK_THAT(pair.push, WithinRel(2.0 / std::sqrt(3.0), 1e-12));
}

TEST_CASE("a load that cannot be held is refused with a motion that proves it",
          "[grasp][property]") {
  const unsigned seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  Random random(seed);
  SpaceHand hand = random_space_hand(random, 3, 3, seed % 4);
  // All fingers press from above: nothing holds what falls.
  for (SpaceFinger& finger : hand.fingers) {
    finger.normal = {random.between(-0.2, 0.2), random.between(-0.2, 0.2), 1.0};
    finger.tangent = cross(finger.normal, {1.0, 0.0, 0.0});
  }
  hand.load = {.force = {0.0, 0.0, -1.0}};
  const double friction = 0.3;
  HoldOptions options{.friction = {friction, friction, friction}};
  if (seed % 2 == 1) options.squeeze = 2.0;
  try {
    (void)held(hand, options);
    FAIL("held");
  } catch (const CannotHoldInSpace& error) {
    CHECK(error.reason() == NoHold::beyond_cones);
    REQUIRE(error.motion());
    const ObjectMotion& motion = *error.motion();
    const auto power = [&](const Eigen::Matrix<double, 6, 1>& wrench) {  // about the origin
      const Eigen::Vector3d at_origin =
          column(motion.velocity) - column(motion.turn).cross(column(motion.point));
      return wrench.head<3>().dot(at_origin) + wrench.tail<3>().dot(column(motion.turn));
    };
    const double driven = power(sum_of({}, hand.load));
    CHECK(driven > 0.0);
    for (int i = 0; i < 1000; ++i) {
      const std::size_t finger = static_cast<std::size_t>(i) % 3;
      CHECK(power(random_wrench(random, hand.fingers[finger], hand.forces[finger].place,
                                friction)) > -1e-6 * driven);
    }
  }
}

TEST_CASE("what contacts cannot bear at all is refused with its screw", "[grasp]") {
  try {
    (void)held(two_opposed(0.0, {.torque = {0.3, 0.0, 0.0}}), least_forces);
    FAIL("held");
  } catch (const CannotHoldInSpace& error) {
    CHECK(error.reason() == NoHold::no_forces);
    const Screw screw = screw_of(error.motion().value(), 1.0);
    CHECK_THAT(screw.direction.x, WithinAbs(1.0, 1e-12));  // the way that the load turns it
    CHECK_THAT(screw.pitch, WithinAbs(0.0, 1e-12));
  }
}

TEST_CASE("a hand in the plane holds the same in space", "[grasp][property]") {
  Random random(2);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const std::size_t fingers = 2 + static_cast<std::size_t>(i) % 2;
    Hand plane = random_hand(random, fingers, 2);
    for (ContactPlace& contact : plane.contacts) contact.deviation = 0.01;
    HoldOptions flat_options{.friction = std::vector<double>(fingers, 1.5)};
    if (i % 3 == 0) flat_options.squeeze = random.between(3.0, 6.0);
    HeldGrasp flat;
    try {
      flat = hold(plane.fingers, plane.contacts, plane.load, flat_options);
    } catch (const std::exception&) {
      continue;
    }
    CAPTURE(i);
    const HeldSpaceGrasp grasp = held(embedded(plane, false), {.squeeze = flat_options.squeeze,
                                                               .friction = flat_options.friction});
    check_same_torques(flat, grasp, 1e-9, 1e-7);
    ++compared;
  }
  CHECK(compared >= 8);
}

TEST_CASE("a hand in the plane is the same hand wherever the plane lies", "[grasp][property]") {
  // So what holds in space of equilibrium, of the least torques and of frames and units holds here.
  Random random(3);
  const Eigen::AngleAxisd turn(0.9, Eigen::Vector3d(1.0, 0.4, -2.0).normalized());
  constexpr double friction = 0.8;
  int compared = 0;
  int bound = 0;  // by their cones
  for (int i = 0; i < 150; ++i) {
    CAPTURE(i);
    const std::size_t fingers = 2 + static_cast<std::size_t>(i) % 3;
    Hand plane = random_hand(random, fingers, 2);
    for (ContactPlace& contact : plane.contacts) contact.deviation = 0.01;
    HoldOptions options{.friction = std::vector<double>(fingers, friction)};
    if (i % 3 == 0) options = {.grasping_force = random.between(1.0, 5.0)};
    HeldGrasp flat;
    try {
      flat = hold(plane.fingers, plane.contacts, plane.load, options);
    } catch (const CannotHold& error) {
      CHECK((i % 3 == 0 || error.reason() == NoHold::beyond_cones));
      continue;
    }
    const HeldSpaceGrasp grasp =
        held(moved(embedded(plane, true), turn, {2.0, -1.0, 3.0}), options);
    const double limit = 1e-9 + 1e-13 * flat.condition;
    CHECK_THAT(grasp.condition.value(), WithinRel(flat.condition, limit));
    for (const SpaceAction& finger : grasp.fingers) CHECK(finger.tangential_z == 0.0);
    check_same_torques(flat, grasp, limit, 100.0 * limit);
    ++compared;
    if (i % 3 == 0) continue;
    CHECK(grasp.optimality < 1e-12);
    double size = 0.0;
    for (const FingerAction& finger : flat.fingers) size = std::fmax(size, length(finger.force));
    for (const FingerAction& finger : flat.fingers) {
      CHECK(std::abs(finger.tangential) < friction * finger.normal + 1e-9 * size);
      bound += std::abs(std::abs(finger.tangential) - friction * finger.normal) < 1e-9 * size;
    }
  }
  CHECK(compared >= 50);
  CHECK(bound >= 20);
}

TEST_CASE("only planar contacts leave no force across the plane to choose", "[grasp]") {
  // Torques about Z do not feel forces along Z, of which three rows of equilibrium fix three.
  Random random(5);
  const Hand plane = random_hand(random, 5, 2);
  CHECK_NOTHROW(held(embedded(plane, true), {}));
  CHECK_THROWS_AS(held(embedded(plane, false), {}), CannotHoldInSpace);
}

TEST_CASE("what holds does not depend on the frame or the units", "[grasp][property]") {
  Random random(4);
  const SpaceHand hand = random_space_hand(random, 3, 3, 2);
  const HoldOptions options{.friction = {0.7, 0.7, 0.7}};
  const std::vector<double> here = torques_of(held(hand, options));
  const Eigen::AngleAxisd turn(1.3, Eigen::Vector3d(1.0, -2.0, 0.5).normalized());
  const std::vector<double> there = torques_of(held(moved(hand, turn, {3.0, -1.0, 2.0}), options));
  SpaceHand tiny = hand;  // millimetres as metres, kilonewtons
  for (std::size_t i = 0; i < 3; ++i) {
    tiny.fingers[i].place = 1e-3 * tiny.fingers[i].place;
    for (SpaceJoint& joint : tiny.fingers[i].joints) joint.place = 1e-3 * joint.place;
    tiny.forces[i].place.y *= 1e-3;
    tiny.forces[i].place.z *= 1e-3;
    if (auto& radius = tiny.forces[i].place.torsion_radius) radius = 1e-3 * *radius;
  }
  tiny.load = {1e3 * hand.load.force, hand.load.torque, 1e-3 * hand.load.point};
  const std::vector<double> other = torques_of(held(tiny, options));
  for (std::size_t i = 0; i < here.size(); ++i) {
    CHECK_THAT(there[i], WithinAbs(here[i], 1e-10));
    CHECK_THAT(other[i], WithinAbs(here[i], 1e-10));
  }
}

TEST_CASE("deviations of what holds are those of small moves of the contacts",
          "[grasp][property]") {
  const unsigned seed = GENERATE(range(0u, 6u));
  CAPTURE(seed);
  Random random(seed);
  const SpaceHand hand = random_space_hand(random, 3, 3, 2);
  HoldOptions options{.friction = {0.7, 0.7, 0.7}};
  if (seed % 2 == 1) options.squeeze = 1.3 * held(hand, options).squeeze;
  const HeldSpaceGrasp grasp = held(hand, options);
  const std::vector<double> here = torques_of(grasp);
  Eigen::MatrixXd by(std::ssize(here), 6);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto places = hand.places();
    covariance.block<2, 2>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(2 * i)) =
        Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(places[i].covariance.data());
    for (int k = 0; k < 2; ++k) {
      const auto at = [&](double way) {
        SpaceHand other = hand;
        (k == 0 ? other.forces[i].place.y : other.forces[i].place.z) += way;
        return torques_of(held(other, options));
      };
      const auto above = at(1e-5);
      const auto below = at(-1e-5);
      for (std::size_t r = 0; r < here.size(); ++r)
        by(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(2 * i) + k) =
            (above[r] - below[r]) / 2e-5;
    }
  }
  const Eigen::MatrixXd expected = by * covariance * by.transpose();
  const double scale = std::sqrt(expected.diagonal().maxCoeff());
  Eigen::Index row = 0;
  for (const SpaceAction& finger : grasp.fingers)
    for (const Uncertain& torque : finger.torques) {
      CHECK_THAT(torque.deviation, WithinAbs(std::sqrt(expected(row, row)), 1e-5 * scale));
      ++row;
    }
}

TEST_CASE("nothing is held with nothing", "[grasp]") {
  const HeldSpaceGrasp grasp = held(two_opposed(0.1, {}), least_forces);
  for (const SpaceAction& action : grasp.fingers) CHECK(is_idle(action));
}

TEST_CASE("what cannot be asked of a hand in space is refused", "[grasp]") {
  Random random(1);
  const SpaceHand good = random_space_hand(random, 2, 3, 2);
  const auto message = [&](const auto& spoil) {
    SpaceHand hand = good;
    HoldOptions options{.friction = {0.5, 0.5}};
    spoil(hand, options);
    try {
      (void)held(hand, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(message([](SpaceHand& h, HoldOptions&) { h.fingers[1].joints.clear(); }) ==
        "finger 'finger 1': without joints there are no least torques");
  CHECK(message([](SpaceHand& h, HoldOptions&) { h.fingers[1].joints[0].slides = true; }) ==
        "some joints slide and some turn: the sum of their squares has no unit; ask for the least "
        "forces");
  CHECK(message([](SpaceHand&, HoldOptions& o) { o.friction = {0.5}; }) ==
        "there must be one coefficient of friction for each finger, or none");
  CHECK(message([](SpaceHand&, HoldOptions& o) {
          o.friction = {0.5, -0.5};
        }) == "friction must be > 0 and finite");
  CHECK(message([](SpaceHand& h, HoldOptions&) { h.load.torque.x = NAN; }) ==
        "the external load must be finite");
  CHECK(message([](SpaceHand& h, HoldOptions&) {
          h.fingers[1].place = h.fingers[0].place;
          h.fingers[1].normal = h.fingers[0].normal;
          h.fingers[1].tangent = h.fingers[0].tangent;
          h.forces[1].place.y = h.forces[0].place.y;
          h.forces[1].place.z = h.forces[0].place.z;
        }) == "the contacts coincide: no line joins them");
  CHECK(message([](SpaceHand& h, HoldOptions&) {
          h.fingers.pop_back();
          h.forces.pop_back();
        }) == "a grasp needs at least two fingers");
}

TEST_CASE("torques that do not feel all forces do not determine them", "[grasp]") {
  // Joints whose axes pass through both contacts: no squeeze costs a torque.
  SpaceHand hand = two_opposed(0.0, {.force = {0.0, 0.0, -1.0}});
  for (SpaceFinger& finger : hand.fingers)
    finger.joints = {{finger.place, {1.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  try {
    (void)held(hand, {.friction = {0.5, 0.5}});
    FAIL("held");
  } catch (const CannotHoldInSpace& error) {
    CHECK(error.reason() == NoHold::undetermined);
  }
}
