#include "tactile_net/calibration/rod_contact.hpp"

#include <cmath>

#include "tests/calibration/layer.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

constexpr double cylinder_radius = 4e-3;

}  // namespace

TEST_CASE("on a half plane a rod's contact is Hertz's") {
  const Material pad{.youngs_modulus = 2e5, .poisson_ratio = 0.3};
  const double a = rod_half_width(pad, 100.0, cylinder_radius);
  CHECK_THAT(a * a, WithinRel(4.0 * 100.0 * cylinder_radius * 0.91 / (M_PI * 2e5), 1e-13));
}

TEST_CASE("on a layer the force over Hertz's grows as computed independently") {
  // A separate study, to the digits that it printed (bonded, nu = 0.45).
  const auto [ratio, expected] = GENERATE(
      table<double, double>({{0.1, 1.009}, {0.3, 1.08}, {0.6, 1.31}, {1.0, 1.76}, {1.5, 2.47}}));
  const double a = ratio * 3e-3;
  const double hertz = M_PI * a * a * 2e5 / (4.0 * cylinder_radius * (1.0 - 0.45 * 0.45));
  const double over = std::exp(rod_force(layer(0.45), a, cylinder_radius).log_force) / hertz;
  CHECK_THAT(over, WithinAbs(expected, 0.006));
}

TEST_CASE("a thick layer is a half plane") {
  Material pad = layer(0.4);
  pad.layer->thickness = 10.0;
  const double a = rod_half_width(pad, 100.0, cylinder_radius);
  pad.layer.reset();
  CHECK_THAT(a, WithinRel(rod_half_width(pad, 100.0, cylinder_radius), 1e-6));
}

TEST_CASE("the half width is the inverse of the force, and its derivatives are right") {
  const Base base = GENERATE(Base::bonded, Base::frictionless);
  const double a = GENERATE(0.4e-3, 1.5e-3, 4e-3);
  const Material pad = layer(0.42, base);
  const ContactForce at = rod_force(pad, a, cylinder_radius);
  CHECK_THAT(rod_half_width(pad, std::exp(at.log_force), cylinder_radius), WithinRel(a, 1e-12));

  const double step = 1e-4;
  const auto slope = [&](const auto& log_force) {
    return (log_force(step) - log_force(-step)) / (2.0 * step);
  };
  CHECK_THAT(at.by_log_half_width,
             WithinAbs(slope([&](double by) {
                         return rod_force(pad, a * std::exp(by), cylinder_radius).log_force;
                       }),
                       1e-7));
  CHECK_THAT(at.by_log_thickness, WithinAbs(slope([&](double by) {
                                              Material other = pad;
                                              other.layer->thickness *= std::exp(by);
                                              return rod_force(other, a, cylinder_radius).log_force;
                                            }),
                                            1e-7));
  CHECK_THAT(at.by_poisson_ratio, WithinAbs(slope([&](double by) {
                                              Material other = pad;
                                              other.poisson_ratio += by;
                                              return rod_force(other, a, cylinder_radius).log_force;
                                            }),
                                            1e-6));
}

}  // namespace tactile_net
