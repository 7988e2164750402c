#include "tactile_net/grasp/space/measured_space_grasp.hpp"

#include <cmath>

#include "tactile_net/grasp/measured_grasp.hpp"
#include "tactile_net/grasp/space/internal_forces.hpp"
#include "tests/catch.hpp"
#include "tests/grasp/space/embedded_hand.hpp"
#include "tests/grasp/space/space_hands.hpp"

using namespace tactile_net;

namespace {

MeasuredSpaceGrasp measured(const SpaceHand& hand) {
  return measured_grasp(hand.fingers, hand.forces, hand.load);
}

/// A number of a fingertip's force, in the order of its covariance.
double& value_of(SpaceFingertipForce& force, std::size_t i) {
  double* const values[] = {&force.normal,  &force.tangential_y, &force.tangential_z,
                            &force.place.y, &force.place.z,      &force.torsion};
  return *values[i];
}

/// All that has a deviation.
std::vector<Uncertain> uncertain_of(const SpaceHand& hand) {
  const MeasuredSpaceGrasp grasp = measured(hand);
  std::vector<Uncertain> all(grasp.unbalanced.begin(), grasp.unbalanced.end());
  for (const SpaceAction& finger : grasp.fingers) {
    all.insert(all.end(), finger.torques.begin(), finger.torques.end());
    all.push_back(friction_margin(finger, 0.7).distance);
  }
  all.push_back(grasp.squeeze.value());
  return all;
}

}  // namespace

TEST_CASE("torques do the work that the forces on the object do", "[grasp][property]") {
  const unsigned seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  Random random(seed);
  SpaceHand hand = random_space_hand(random, 3, 3, 2);
  hand.fingers[1].joints[0].slides = true;
  const MeasuredSpaceGrasp grasp = measured(hand);
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    const SpaceAction& action = grasp.fingers[i];
    for (std::size_t j = 0; j < 3; ++j) {
      // The point and the pad carried along by the joint, by differences of rotations.
      const SpaceJoint& joint = hand.fingers[i].joints[j];
      const double angle = 1e-5;
      const Eigen::Vector3d axis = column(joint.axis).normalized();
      const auto at = [&](double way) -> Eigen::Vector3d {
        if (joint.slides) return column(action.point) + way * axis;
        return column(joint.place) +
               Eigen::AngleAxisd(way, axis) * (column(action.point) - column(joint.place));
      };
      double work = column(action.force).dot(at(angle) - at(-angle)) / (2.0 * angle);
      if (!joint.slides) work += column(action.moment).dot(axis);
      CHECK_THAT(action.torques[j].value, WithinAbs(work, 1e-8));
    }
  }
}

TEST_CASE("what is not balanced is the sum of all forces and moments", "[grasp][property]") {
  Random random(3);
  const SpaceHand hand = random_space_hand(random, 4, 2, 2);
  const MeasuredSpaceGrasp grasp = measured(hand);
  Eigen::Matrix<double, 6, 1> sum = sum_of(grasp.fingers, hand.load);
  sum.tail<3>() -= column(hand.load.point).cross(sum.head<3>());  // about the load's point
  for (std::size_t i = 0; i < 6; ++i)
    CHECK_THAT(grasp.unbalanced[i].value, WithinAbs(sum(static_cast<Eigen::Index>(i)), 1e-13));
}

TEST_CASE("torques, margins and deviations do not depend on the frame", "[grasp][property]") {
  const unsigned seed = GENERATE(range(0u, 10u));
  CAPTURE(seed);
  Random random(seed);
  const SpaceHand hand = random_space_hand(random, 3, 3, 1);
  const Eigen::AngleAxisd turn(random.between(-3.0, 3.0),
                               column(random_vector(random, 1.0)).normalized());
  const MeasuredSpaceGrasp here = measured(hand);
  const MeasuredSpaceGrasp there = measured(moved(hand, turn, random_vector(random, 5.0)));
  for (std::size_t i = 0; i < here.fingers.size(); ++i) {
    for (std::size_t j = 0; j < here.fingers[i].torques.size(); ++j) {
      CHECK_THAT(there.fingers[i].torques[j].value,
                 WithinAbs(here.fingers[i].torques[j].value, 1e-12));
      CHECK_THAT(there.fingers[i].torques[j].deviation,
                 WithinAbs(here.fingers[i].torques[j].deviation, 1e-12));
    }
    const FrictionMargin one = friction_margin(here.fingers[i], 0.8);
    const FrictionMargin other = friction_margin(there.fingers[i], 0.8);
    CHECK_THAT(other.distance.value, WithinAbs(one.distance.value, 1e-12));
    CHECK_THAT(other.distance.deviation, WithinAbs(one.distance.deviation, 1e-12));
    CHECK(other.verdict == one.verdict);
  }
  CHECK_THAT(there.chi_squared.value(), WithinRel(here.chi_squared.value(), 1e-8));
  CHECK_THAT(there.squeeze->value, WithinAbs(here.squeeze->value, 1e-12));
  CHECK_THAT(there.squeeze->deviation, WithinAbs(here.squeeze->deviation, 1e-12));
}

TEST_CASE("deviations are those of small changes of what is measured", "[grasp][property]") {
  Random random(5);
  const SpaceHand hand = random_space_hand(random, 3, 3, 2);
  const std::vector<Uncertain> here = uncertain_of(hand);
  Eigen::MatrixXd by(std::ssize(here), 18);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(18, 18);
  for (std::size_t i = 0; i < 3; ++i) {
    covariance.block<6, 6>(static_cast<Eigen::Index>(6 * i), static_cast<Eigen::Index>(6 * i)) =
        Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(
            hand.forces[i].covariance.data());
    for (std::size_t k = 0; k < 6; ++k) {
      const auto column = static_cast<Eigen::Index>(6 * i + k);
      by.col(column).setZero();
      if (k == 5 && !hand.forces[i].place.torsion_radius) continue;
      SpaceHand more = hand;
      SpaceHand less = hand;
      value_of(more.forces[i], k) += 1e-5;
      value_of(less.forces[i], k) -= 1e-5;
      const auto above = uncertain_of(more);
      const auto below = uncertain_of(less);
      for (std::size_t r = 0; r < here.size(); ++r)
        by(static_cast<Eigen::Index>(r), column) = (above[r].value - below[r].value) / 2e-5;
    }
  }
  const Eigen::MatrixXd expected = by * covariance * by.transpose();
  for (std::size_t r = 0; r < here.size(); ++r) {
    CAPTURE(r);
    const auto at = static_cast<Eigen::Index>(r);
    CHECK_THAT(here[r].deviation, WithinRel(std::sqrt(expected(at, at)), 1e-7));
  }
}

TEST_CASE("a hand in the plane means the same in space", "[grasp][property]") {
  const unsigned seed = GENERATE(range(0u, 10u));
  CAPTURE(seed);
  Random random(seed);
  const Hand plane = random_hand(random, 3, 2);
  std::vector<FingertipForce> forces;
  for (const ContactPlace& contact : plane.contacts) {
    FingertipForce force{.normal = random.between(0.5, 2.0),
                         .tangential = random.between(-1.0, 1.0),
                         .centre = contact.centre};
    force.covariance.values = {4e-4, 1e-4, 2e-5, 1e-4, 9e-4, 3e-5, 2e-5, 3e-5, 1e-4};
    forces.push_back(force);
  }
  const MeasuredGrasp flat = measured_grasp(plane.fingers, forces, plane.load);
  const SpaceHand space = embedded(plane, forces, false);
  const MeasuredSpaceGrasp grasp = measured(space);
  for (std::size_t i = 0; i < flat.fingers.size(); ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      CHECK_THAT(grasp.fingers[i].torques[j].value,
                 WithinAbs(flat.fingers[i].torques[j].value, 1e-12));
      CHECK_THAT(grasp.fingers[i].torques[j].deviation,
                 WithinAbs(flat.fingers[i].torques[j].deviation, 1e-12));
    }
    const FrictionMargin one = friction_margin(flat.fingers[i], 0.6);
    const FrictionMargin other = friction_margin(grasp.fingers[i], 0.6);
    CHECK_THAT(other.distance.value, WithinAbs(one.distance.value, 1e-12));
    CHECK_THAT(other.distance.deviation, WithinAbs(one.distance.deviation, 1e-12));
    CHECK_THAT(other.angle, WithinAbs(one.angle, 1e-12));
  }
  for (const std::size_t i : {0u, 1u})
    CHECK_THAT(grasp.unbalanced[i].value, WithinAbs(flat.unbalanced[i].value, 1e-12));
  CHECK_THAT(grasp.unbalanced[5].value, WithinAbs(flat.unbalanced[2].value, 1e-12));
  CHECK_THAT(grasp.unbalanced[5].deviation, WithinAbs(flat.unbalanced[2].deviation, 1e-12));
  CHECK_THAT(grasp.squeeze->value, WithinAbs(flat.squeeze->value, 1e-12));
  CHECK_THAT(grasp.squeeze->deviation, WithinAbs(flat.squeeze->deviation, 1e-12));
}

TEST_CASE("a Jacobian says what its joints say", "[grasp][property]") {
  Random random(7);
  SpaceHand hand = random_space_hand(random, 2, 3, 1);
  const MeasuredSpaceGrasp by_joints = measured(hand);
  for (SpaceFinger& finger : hand.fingers) {
    Matrix jacobian{6, 3, std::vector<double>(18)};
    for (std::size_t j = 0; j < 3; ++j) {
      const Eigen::Vector3d axis = column(finger.joints[j].axis).normalized();
      const Eigen::Vector3d velocity =
          axis.cross(column(finger.place) - column(finger.joints[j].place));
      for (std::size_t i = 0; i < 3; ++i) {
        jacobian(i, j) = velocity(static_cast<Eigen::Index>(i));
        jacobian(3 + i, j) = axis(static_cast<Eigen::Index>(i));
      }
    }
    finger.joints.clear();
    finger.jacobian = jacobian;
  }
  const MeasuredSpaceGrasp by_jacobian = measured(hand);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      CHECK_THAT(by_jacobian.fingers[i].torques[j].value,
                 WithinAbs(by_joints.fingers[i].torques[j].value, 1e-13));
}

TEST_CASE("internal forces are those that two contacts push against each other", "[grasp]") {
  Random random(11);
  SpaceHand hand = random_space_hand(random, 3, 3, 0);
  std::vector<SpaceAction> actions = measured(hand).fingers;
  // Nothing but pushes along the three lines: 2, 3 and -1.
  const std::array<std::array<double, 3>, 3> pushes{{{0, 1, 2.0}, {0, 2, 3.0}, {1, 2, -1.0}}};
  for (SpaceAction& action : actions) action.force = {};
  for (const auto& [a, b, push] : pushes) {
    SpaceAction& one = actions[static_cast<std::size_t>(a)];
    SpaceAction& other = actions[static_cast<std::size_t>(b)];
    const Vector3 way = other.point - one.point;
    one.force = one.force + push / length(way) * way;
    other.force = other.force - push / length(way) * way;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const PadFrame pad = pad_frame(hand.fingers[i]);
    actions[i].normal = -dot(actions[i].force, pad.x);
    actions[i].tangential_y = -dot(actions[i].force, pad.y);
    actions[i].tangential_z = -dot(actions[i].force, pad.z);
  }
  CHECK(sum_of(actions, {}).norm() < 1e-12);
  const InternalForces internal = internal_forces(hand.fingers, actions);
  CHECK(internal.forces == 9);
  CHECK(internal.rank == 6);
  CHECK(internal.count() == 3);
  CHECK(internal.free.empty());
  REQUIRE(internal.pairs.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK_THAT(internal.pairs[i].push, WithinAbs(pushes[i][2], 1e-11));
  CHECK(internal.rest < 1e-11);
}

TEST_CASE("two hard contacts leave an object free to turn about the line between them", "[grasp]") {
  const SpaceHand hand = two_opposed(0.0, {});
  std::vector<SpaceAction> actions = measured(hand).fingers;
  const InternalForces hard = internal_forces(hand.fingers, actions);
  CHECK(hard.rank == 5);
  CHECK(hard.count() == 1);
  REQUIRE(hard.free.size() == 1);
  const Screw screw = screw_of(hard.free[0], 1.0);
  CHECK_THAT(std::abs(screw.direction.x), WithinAbs(1.0, 1e-12));
  CHECK_THAT(screw.pitch, WithinAbs(0.0, 1e-12));
  CHECK_THAT(length(cross(screw.direction, screw.point)), WithinAbs(0.0, 1e-12));

  const SpaceHand soft_hand = two_opposed(0.1, {});
  const InternalForces soft = internal_forces(soft_hand.fingers, measured(soft_hand).fingers);
  CHECK(soft.forces == 8);
  CHECK(soft.rank == 6);
  CHECK(soft.count() == 2);
  CHECK(soft.free.empty());
}

TEST_CASE("a finger in space that cannot be is refused by name", "[grasp]") {
  Random random(1);
  const SpaceHand good = random_space_hand(random, 2, 2, 1);
  const auto message = [&](const auto& spoil) {
    SpaceHand hand = good;
    spoil(hand);
    try {
      (void)measured(hand);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(message([](SpaceHand& h) { h.fingers[0].normal = {}; }) ==
        "finger 'finger 0': its normal must not be zero");
  CHECK(message([](SpaceHand& h) { h.fingers[1].tangent = h.fingers[1].normal; }) ==
        "finger 'finger 1': its normal and tangent must be at right angles");
  CHECK(message([](SpaceHand& h) { h.fingers[0].joints[1].axis = {}; }) ==
        "finger 'finger 0': a joint's place and axis must be finite, and its axis not zero");
  CHECK(message([](SpaceHand& h) {
          h.fingers[0].jacobian = Matrix{6, 1, {0, 0, 0, 0, 0, 0}};
        }) == "finger 'finger 0': joints and a Jacobian exclude each other");
  CHECK(message([](SpaceHand& h) { h.forces[0].normal = -1.0; }) ==
        "finger 'finger 0': the normal force must be > 0: it points into the pad");
  CHECK(message([](SpaceHand& h) { h.forces[1].torsion = 0.1; }) ==
        "finger 'finger 1': a hard finger has no torsion: a soft one has a radius of it");
  CHECK(message([](SpaceHand& h) { h.forces[0].place.torsion_radius = 0.0; }) ==
        "finger 'finger 0': the radius of its torsion must be > 0 and finite");
  CHECK(message([](SpaceHand& h) { h.forces[0].place.planar = true; }) ==
        "finger 'finger 0': a planar contact has no force along z");
  CHECK(message([](SpaceHand& h) { h.forces[0].covariance[0] = -1.0; }) ==
        "finger 'finger 0': the covariance of its contact must be finite, and its variances >= 0");
  CHECK(message([](SpaceHand& h) { h.fingers.pop_back(); }) ==
        "there must be one fingertip force for each finger");
}
