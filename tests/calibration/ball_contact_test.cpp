#include "tactile_net/calibration/ball_contact.hpp"

#include <cmath>

#include "tests/calibration/layer.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

constexpr double ball_radius = 5e-3;

}  // namespace

TEST_CASE("on a half space a ball's contact is Hertz's") {
  const Material pad{.youngs_modulus = 2e5, .poisson_ratio = 0.3};
  const double a = ball_contact_radius(pad, 0.4, ball_radius);
  CHECK_THAT(a * a * a, WithinRel(3.0 * 0.4 * ball_radius * 0.91 / (4.0 * 2e5), 1e-12));
}

TEST_CASE("a thick layer under a ball is a half space") {
  Material pad = layer(0.4);
  pad.layer->thickness = 1e4;
  const double a = ball_contact_radius(pad, 0.4, ball_radius);
  pad.layer.reset();
  CHECK_THAT(a, WithinRel(ball_contact_radius(pad, 0.4, ball_radius), 1e-6));
}

TEST_CASE("a layer on a slippery base is thin foundation under a wide ball") {
  // Far wider than the layer is thick, it is a bed of springs: p = E d / (h (1 - nu^2)) under a
  // sphere of the depth d(r) = (a^2 - r^2) / 2 R, and F = pi E a^4 / (4 R h (1 - nu^2)).
  const Material pad = layer(0.3, Base::frictionless);
  const double h = pad.layer->thickness;
  const auto over = [&](double ratio) {
    const double a = ratio * h;
    const double bed = M_PI * 2e5 * std::pow(a, 4) / (4.0 * ball_radius * h * (1.0 - 0.09));
    return std::exp(ball_force(pad, a, ball_radius).log_force) / bed;
  };
  CHECK(over(3.0) > 1.0);
  CHECK(over(3.0) < over(2.0));
  CHECK_THAT(over(3.0), WithinAbs(1.0, 0.45));
}

TEST_CASE("the contact's radius is the inverse of a ball's force, and its derivatives are right") {
  const Base base = GENERATE(Base::bonded, Base::frictionless);
  const double a = GENERATE(0.4e-3, 1.5e-3, 4e-3);
  const Material pad = layer(0.42, base);
  const ContactForce at = ball_force(pad, a, ball_radius);
  CHECK_THAT(ball_contact_radius(pad, std::exp(at.log_force), ball_radius), WithinRel(a, 1e-12));

  const double step = 1e-4;
  const auto slope = [&](const auto& log_force) {
    return (log_force(step) - log_force(-step)) / (2.0 * step);
  };
  CHECK_THAT(at.by_log_half_width,
             WithinAbs(slope([&](double by) {
                         return ball_force(pad, a * std::exp(by), ball_radius).log_force;
                       }),
                       1e-7));
  CHECK_THAT(at.by_log_thickness, WithinAbs(slope([&](double by) {
                                              Material other = pad;
                                              other.layer->thickness *= std::exp(by);
                                              return ball_force(other, a, ball_radius).log_force;
                                            }),
                                            1e-7));
  CHECK_THAT(at.by_poisson_ratio, WithinAbs(slope([&](double by) {
                                              Material other = pad;
                                              other.poisson_ratio += by;
                                              return ball_force(other, a, ball_radius).log_force;
                                            }),
                                            1e-6));
}

}  // namespace tactile_net
