#include "tactile_net/grasp/measured_grasp.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "tactile_net/grasp/hold.hpp"
#include "tests/catch.hpp"
#include "tests/grasp/hands.hpp"

using namespace tactile_net;

namespace {

/// A positive definite covariance, about `size` of the values.
ContactCovariance<3> random_covariance(Random& random, const std::array<double, 3>& size) {
  Eigen::Matrix3d root;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      root(i, j) = size[static_cast<std::size_t>(i)] * random.between(-1.0, 1.0);
  const Eigen::Matrix3d c = root * root.transpose();
  ContactCovariance<3> covariance;
  for (std::size_t i = 0; i < 9; ++i)
    covariance.values[i] = c(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
  return covariance;
}

std::vector<FingertipForce> random_forces(Random& random, const Hand& hand) {
  std::vector<FingertipForce> forces;
  for (const ContactPlace& contact : hand.contacts)
    forces.push_back({random.between(0.5, 4.0), random.between(-2.0, 2.0), 0.9 * contact.centre,
                      random_covariance(random, {0.1, 0.1, 0.02})});
  return forces;
}

/// Everything that is reported, in one row: torques, unbalanced, squeeze, grasping force.
std::vector<double> values_of(const MeasuredGrasp& grasp) {
  std::vector<double> values;
  for (const FingerAction& finger : grasp.fingers)
    for (const Uncertain& torque : finger.torques) values.push_back(torque.value);
  for (const Uncertain& one : grasp.unbalanced) values.push_back(one.value);
  if (grasp.squeeze) values.push_back(grasp.squeeze->value);
  if (grasp.grasping_force) values.push_back(grasp.grasping_force->value);
  return values;
}

std::vector<double> deviations_of(const MeasuredGrasp& grasp) {
  std::vector<double> values;
  for (const FingerAction& finger : grasp.fingers)
    for (const Uncertain& torque : finger.torques) values.push_back(torque.deviation);
  for (const Uncertain& one : grasp.unbalanced) values.push_back(one.deviation);
  if (grasp.squeeze) values.push_back(grasp.squeeze->deviation);
  if (grasp.grasping_force) values.push_back(grasp.grasping_force->deviation);
  return values;
}

}  // namespace

TEST_CASE("a fingertip pushes the object out of its pad", "[grasp]") {
  // A finger along X whose pad looks up: what presses on it from above is held up by it.
  Finger finger;
  finger.links = {2.0};
  finger.angles = {0.0};
  finger.pad = {.center = 1.5, .half_width = 0.5};
  const std::vector<FingertipForce> forces = {{3.0, 1.0, 0.2}};
  const MeasuredGrasp grasp =
      measured_grasp(std::vector{finger}, forces, {{1.0, -3.0}, 0.0, {1.7, 0.0}});
  CHECK_THAT(grasp.fingers[0].force.y, WithinRel(3.0, 1e-15));
  CHECK_THAT(grasp.fingers[0].force.x, WithinRel(-1.0, 1e-15));
  CHECK_THAT(grasp.fingers[0].torques[0].value, WithinRel(3.0 * 1.7, 1e-15));
  for (const Uncertain& one : grasp.unbalanced) CHECK_THAT(one.value, WithinAbs(0.0, 1e-15));
  CHECK(grasp.unbalanced_share < 1e-15);
  CHECK_FALSE(grasp.chi_squared.has_value());
  CHECK_FALSE(grasp.squeeze.has_value());
}

TEST_CASE("forces that hold a load are measured as balanced, with the torques that hold it",
          "[grasp][property]") {
  Random random(1);
  int pressing = 0;
  for (int trial = 0; trial < 4000 && pressing < 40; ++trial) {
    const Hand hand = random_hand(random, 2 + static_cast<std::size_t>(trial % 2), 2);
    HoldOptions options;
    if (hand.fingers.size() == 2)
      options.grasping_force = 8.0;
    else
      options.squeeze = 12.0;
    const HeldGrasp held = hold(hand.fingers, hand.contacts, hand.load, options);
    std::vector<FingertipForce> forces;
    bool all = held.condition < 1e4;
    for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
      forces.push_back(
          {held.fingers[i].normal, held.fingers[i].tangential, hand.contacts[i].centre});
      all = all && forces.back().normal > 0.0;
    }
    if (!all) continue;
    ++pressing;
    CAPTURE(trial);
    const MeasuredGrasp measured = measured_grasp(hand.fingers, forces, hand.load);
    CHECK(measured.unbalanced_share < 1e-9);
    CHECK(std::abs(measured.unbalanced[2].value) < 1e-8);
    CHECK_THAT(measured.squeeze->value, WithinAbs(held.squeeze, 1e-8));
    if (measured.grasping_force) CHECK_THAT(measured.grasping_force->value, WithinAbs(8.0, 1e-8));
    for (std::size_t i = 0; i < hand.fingers.size(); ++i)
      for (std::size_t j = 0; j < 2; ++j)
        CHECK_THAT(measured.fingers[i].torques[j].value,
                   WithinAbs(held.fingers[i].torques[j].value, 1e-8));
  }
  CHECK(pressing == 40);
}

TEST_CASE("every deviation is that of central differences", "[grasp][property]") {
  Random random(2);
  for (const std::size_t fingers : {1U, 2U, 3U}) {
    CAPTURE(fingers);
    const Hand hand = random_hand(random, fingers, 3);
    const std::vector<FingertipForce> forces = random_forces(random, hand);
    const MeasuredGrasp grasp = measured_grasp(hand.fingers, forces, hand.load);
    const std::vector<double> values = values_of(grasp);
    const auto n = static_cast<Eigen::Index>(values.size());
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < fingers; ++i) {
      Eigen::MatrixXd by(n, 3);
      for (Eigen::Index p = 0; p < 3; ++p) {
        constexpr double h = 1e-5;
        const auto at = [&](double step) {
          std::vector<FingertipForce> changed = forces;
          (p == 0 ? changed[i].normal : p == 1 ? changed[i].tangential : changed[i].centre) += step;
          return values_of(measured_grasp(hand.fingers, changed, hand.load));
        };
        const std::vector<double> a = at(h);
        const std::vector<double> b = at(-h);
        for (Eigen::Index k = 0; k < n; ++k)
          by(k, p) = (a[static_cast<std::size_t>(k)] - b[static_cast<std::size_t>(k)]) / (2.0 * h);
      }
      const Eigen::Matrix3d felt =
          Eigen::Map<const Eigen::Matrix3d>(forces[i].covariance.values.data());
      c += by * felt * by.transpose();
    }
    const std::vector<double> deviations = deviations_of(grasp);
    for (Eigen::Index k = 0; k < n; ++k)
      CHECK_THAT(deviations[static_cast<std::size_t>(k)], WithinRel(std::sqrt(c(k, k)), 1e-6));
    const std::size_t joints = 3 * fingers;
    for (std::size_t i = 0; i < joints; ++i)
      for (std::size_t j = 0; j < joints; ++j)
        CHECK_THAT(grasp.torque_covariance(i, j),
                   WithinAbs(c(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                             1e-6 * c.diagonal().maxCoeff()));
    for (std::size_t i = 0; i < fingers; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        CHECK_THAT(grasp.fingers[i].covariance.values[k],
                   WithinAbs(forces[i].covariance.values[3 * (k / 2) + k % 2], 1e-14));
  }
}

TEST_CASE("99 % of grasps in equilibrium are called balanced, and a force too much is not",
          "[grasp][property]") {
  Random random(3);
  Hand hand;
  std::vector<FingertipForce> exact;
  do {  // until both fingers press
    hand = random_hand(random, 2, 2);
    for (ContactPlace& contact : hand.contacts) contact.centre *= 0.5;
    const HeldGrasp held = hold(hand.fingers, hand.contacts, hand.load, {.grasping_force = 9.0});
    exact.clear();
    for (std::size_t i = 0; i < 2; ++i)
      exact.push_back({held.fingers[i].normal, held.fingers[i].tangential, hand.contacts[i].centre,
                       random_covariance(random, {0.02, 0.02, 0.004})});
  } while (exact[0].normal < 1.0 || exact[1].normal < 1.0);
  constexpr int trials = 4000;
  int beyond = 0;
  int noticed = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<FingertipForce> noisy = exact;
    for (FingertipForce& force : noisy) {
      const Eigen::Matrix3d c = Eigen::Map<const Eigen::Matrix3d>(force.covariance.values.data());
      const Eigen::Matrix3d root = c.llt().matrixL();
      const Eigen::Vector3d error =
          root * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      force.normal += error(0);
      force.tangential += error(1);
      force.centre += error(2);
    }
    const auto chi = [&](const ExternalLoad& load) {
      return *measured_grasp(hand.fingers, noisy, load).chi_squared;
    };
    beyond += chi(hand.load) > balanced_limit ? 1 : 0;
    ExternalLoad heavier = hand.load;
    heavier.force.y -= 0.5;
    noticed += chi(heavier) > balanced_limit ? 1 : 0;
  }
  // Binomial: 40 expected of 4000, standard deviation 6.3.
  CHECK(beyond > 40 - 32);
  CHECK(beyond < 40 + 32);
  CHECK(noticed > trials / 2);
}

TEST_CASE("the limit of balance is the quantile of chi squared", "[grasp]") {
  // P(chi^2_3 <= x) = erf(sqrt(x/2)) - sqrt(2x/pi) exp(-x/2).
  const double x = balanced_limit;
  const double p =
      std::erf(std::sqrt(0.5 * x)) - std::sqrt(2.0 * x / std::numbers::pi) * std::exp(-0.5 * x);
  CHECK_THAT(p, WithinRel(0.99, 1e-12));
}

TEST_CASE("a measured grasp without fingers, or with a wrong one, is refused", "[grasp]") {
  Random random(5);
  const Hand hand = random_hand(random, 2, 2);
  std::vector<FingertipForce> forces = {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  CHECK_THROWS_WITH(measured_grasp(std::vector<Finger>{}, {}, {}),
                    ContainsSubstring("at least one finger"));
  CHECK_THROWS_WITH(measured_grasp(hand.fingers, std::vector{forces[0]}, {}),
                    ContainsSubstring("one fingertip force for each"));
  CHECK_THROWS_WITH(measured_grasp(hand.fingers, forces, {{0.0, NAN}}),
                    ContainsSubstring("load must be finite"));
  forces[1].normal = -1.0;
  CHECK_THROWS_WITH(measured_grasp(hand.fingers, forces, {}), ContainsSubstring("'finger 1'"));
}
