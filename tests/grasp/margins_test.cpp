#include "tactile_net/grasp/margins.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

FingerAction action(double normal, double tangential) {
  FingerAction result;
  result.normal = normal;
  result.tangential = tangential;
  return result;
}

}  // namespace

TEST_CASE("on the cone's edge nothing is left; along the normal, mu F / sqrt(1 + mu^2)",
          "[grasp]") {
  for (const double mu : {0.1, 0.5, 2.0})
    for (const double side : {-1.0, 1.0}) {
      const FrictionMargin edge = friction_margin(action(3.0, side * mu * 3.0), mu);
      CHECK_THAT(edge.distance.value, WithinAbs(0.0, 1e-15));
      CHECK_THAT(edge.angle, WithinAbs(0.0, 1e-15));
      CHECK_THAT(edge.used, WithinRel(1.0, 1e-15));
      const FrictionMargin middle = friction_margin(action(3.0, 0.0), mu);
      CHECK_THAT(middle.distance.value, WithinRel(3.0 * std::sin(std::atan(mu)), 1e-14));
      CHECK(middle.verdict == ContactVerdict::holds);
      CHECK(middle.used == 0.0);
    }
}

TEST_CASE("the distance is how far the force can move before the edge", "[grasp][property]") {
  // The nearest point of the edge's line, found by minimising over the line.
  const double mu = 0.6;
  const FingerAction force = action(2.0, -0.7);
  double nearest = 1e9;
  for (int i = 0; i <= 100000; ++i) {
    const double normal = 4.0 * i / 100000.0;
    nearest = std::fmin(nearest, std::hypot(normal - 2.0, -mu * normal + 0.7));
  }
  CHECK_THAT(friction_margin(force, mu).distance.value, WithinRel(nearest, 1e-6));
}

TEST_CASE("a force outside the cone slips, one that does not press pulls", "[grasp]") {
  CHECK(friction_margin(action(1.0, 0.6), 0.5).verdict == ContactVerdict::slips);
  CHECK(friction_margin(action(1.0, -0.6), 0.5).distance.value < 0.0);
  CHECK(friction_margin(action(0.0, 0.0), 0.5).verdict == ContactVerdict::idle);
  CHECK(friction_margin(action(0.0, 1.0), 0.5).verdict == ContactVerdict::pulls);
  CHECK(friction_margin(action(-1.0, 0.0), 0.5).verdict == ContactVerdict::pulls);
  CHECK(std::isinf(friction_margin(action(-1.0, 0.0), 0.5).used));
}

TEST_CASE("a force that uses all of its friction does not slip by rounding", "[grasp]") {
  for (int i = 1; i <= 1000; ++i) {
    CAPTURE(i);
    const double mu = 0.1 + 1e-3 * i;
    const double drag = 0.7 * i;
    const FrictionMargin edge = friction_margin(action(drag / mu, drag), mu);
    CHECK(edge.verdict == ContactVerdict::holds);
    CHECK(edge.distance.value >= 0.0);
    CHECK(friction_margin(action((1.0 - 1e-9) * drag / mu, drag), mu).verdict ==
          ContactVerdict::slips);
  }
}

TEST_CASE("the margin's deviation is that of its own edge", "[grasp][property]") {
  const double mu = 0.4;
  for (const double side : {-1.0, 1.0}) {
    FingerAction force = action(2.0, side * 0.3);
    force.covariance = {0.04, 0.01, 0.01, 0.09};
    const double scale = 1.0 / std::sqrt(1.0 + mu * mu);
    // var(mu F_v -+ F_t) by hand.
    const double variance = (mu * mu * 0.04 + 0.09 - side * 2.0 * mu * 0.01) * scale * scale;
    CHECK_THAT(friction_margin(force, mu).distance.deviation,
               WithinRel(std::sqrt(variance), 1e-14));
  }
}

TEST_CASE("a torque's margin counts both ways", "[grasp]") {
  CHECK(torque_margin(-3.0, 4.0).left == 1.0);
  CHECK(torque_margin(5.0, 4.0).left == -1.0);
  CHECK(torque_margin(2.0, 4.0).used == 0.5);
}
