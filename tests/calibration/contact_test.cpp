/// @file
/// The contacts of rods and of balls: Hertz's, on layers, and each the inverse of its force.
#include <cmath>

#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/calibration/rod_contact.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

struct Indenter {
  const char* what;
  double radius;
  double load;  ///< of a rod [N/m], of a ball [N]
  ContactForce (*force)(const Material&, double, double);
  double (*width)(const Material&, double, double);
};

const Indenter rod{"rod", 4e-3, 100.0, rod_force, rod_half_width};
const Indenter ball{"ball", 5e-3, 0.4, ball_force, ball_contact_radius};

Material layer(double nu, Base base = Base::bonded) {
  return {.youngs_modulus = 2e5, .poisson_ratio = nu, .layer = Layer{3e-3, base}};
}

}  // namespace

TEST_CASE("on a half space a contact is Hertz's") {
  const Material pad{.youngs_modulus = 2e5, .poisson_ratio = 0.3};
  const double a = rod.width(pad, rod.load, rod.radius);
  CHECK_THAT(a * a, WithinRel(4.0 * rod.load * rod.radius * 0.91 / (M_PI * 2e5), 1e-13));
  const double b = ball.width(pad, ball.load, ball.radius);
  CHECK_THAT(b * b * b, WithinRel(3.0 * ball.load * ball.radius * 0.91 / (4.0 * 2e5), 1e-12));
}

TEST_CASE("on a layer the force over Hertz's grows as computed independently") {
  // A separate study, to the digits that it printed (bonded, nu = 0.45).
  const auto [ratio, expected] = GENERATE(
      table<double, double>({{0.1, 1.009}, {0.3, 1.08}, {0.6, 1.31}, {1.0, 1.76}, {1.5, 2.47}}));
  const double a = ratio * 3e-3;
  const double hertz = M_PI * a * a * 2e5 / (4.0 * rod.radius * (1.0 - 0.45 * 0.45));
  const double over = std::exp(rod_force(layer(0.45), a, rod.radius).log_force) / hertz;
  CHECK_THAT(over, WithinAbs(expected, 0.006));
}

TEST_CASE("a thick layer is a half space") {
  for (const Indenter& one : {rod, ball}) {
    Material pad = layer(0.4);
    pad.layer->thickness = 1e4;
    const double a = one.width(pad, one.load, one.radius);
    pad.layer.reset();
    CAPTURE(one.what);
    CHECK_THAT(a, WithinRel(one.width(pad, one.load, one.radius), 1e-6));
  }
}

TEST_CASE("a layer on a slippery base is thin foundation under a wide ball") {
  // Far wider than the layer is thick, it is a bed of springs: p = E d / (h (1 - nu^2)) under a
  // sphere of the depth d(r) = (a^2 - r^2) / 2 R, and F = pi E a^4 / (4 R h (1 - nu^2)).
  const Material pad = layer(0.3, Base::frictionless);
  const double h = pad.layer->thickness;
  const auto over = [&](double ratio) {
    const double a = ratio * h;
    const double bed = M_PI * 2e5 * std::pow(a, 4) / (4.0 * ball.radius * h * (1.0 - 0.09));
    return std::exp(ball_force(pad, a, ball.radius).log_force) / bed;
  };
  CHECK(over(3.0) > 1.0);
  CHECK(over(3.0) < over(2.0));
  CHECK_THAT(over(3.0), WithinAbs(1.0, 0.45));
}

TEST_CASE("a contact's width is the inverse of its force, whose derivatives are right") {
  const Indenter one = GENERATE(rod, ball);
  const Base base = GENERATE(Base::bonded, Base::frictionless);
  const double a = GENERATE(0.4e-3, 1.5e-3, 4e-3);
  const Material pad = layer(0.42, base);
  const ContactForce at = one.force(pad, a, one.radius);
  CAPTURE(one.what, static_cast<int>(base), a);
  CHECK_THAT(one.width(pad, std::exp(at.log_force), one.radius), WithinRel(a, 1e-12));

  const double step = 1e-4;
  const auto slope = [&](const auto& change) {
    const auto log_force = [&](double by) {
      Material other = pad;
      double width = a;
      change(other, width, by);
      return one.force(other, width, one.radius).log_force;
    };
    return (log_force(step) - log_force(-step)) / (2.0 * step);
  };
  const double by_width = slope([](Material&, double& width, double by) { width *= std::exp(by); });
  const double by_thickness =
      slope([](Material& other, double&, double by) { other.layer->thickness *= std::exp(by); });
  const double by_nu =
      slope([](Material& other, double&, double by) { other.poisson_ratio += by; });
  CHECK_THAT(at.by_log_half_width, WithinAbs(by_width, 1e-7));
  CHECK_THAT(at.by_log_thickness, WithinAbs(by_thickness, 1e-7));
  CHECK_THAT(at.by_poisson_ratio, WithinAbs(by_nu, 1e-6));
}

}  // namespace tactile_net
