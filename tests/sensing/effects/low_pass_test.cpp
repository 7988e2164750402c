#include "tactile_net/sensing/effects/low_pass.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "sensing/effects/first_order_lag.hpp"
#include "tests/catch.hpp"
#include "tests/sensing/effects/two_taxels.hpp"

using namespace tactile_net;

namespace {

/// What comes out at each time of a signal that is `in(t)` at those times, at rest before.
std::vector<double> response(double tau, const std::vector<double>& times, auto in) {
  const auto stage = make_effect(LowPass{tau}, two_taxels);
  std::vector<double> rest(2);
  stage->rest(rest);
  std::vector<double> out;
  double before = 0.0;
  for (const double t : times) {
    std::vector<double> readings(2, in(t));
    stage->apply({.time = t, .since = t - before}, readings);
    CHECK(readings[0] == readings[1]);
    out.push_back(readings[0]);
    before = t;
  }
  return out;
}

}  // namespace

TEST_CASE("the lag's weights add up to one and keep is the exponential", "[effects][property]") {
  for (const double ratio : {0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.4999, 0.5, 1.0, 10.0, 800.0}) {
    CAPTURE(ratio);
    const FirstOrderLag lag = first_order_lag(3.0 * ratio, 3.0);
    CHECK_THAT(lag.keep + lag.before + lag.now, WithinAbs(1.0, 4e-16));
    CHECK_THAT(lag.keep, WithinAbs(std::exp(-ratio), 2e-16));
    CHECK(lag.now >= 0.0);
    CHECK(lag.before >= 0.0);
    if (ratio > 0.0 && ratio < 1e-3)  // of first order, half the step belongs to either end
      CHECK_THAT(lag.now / ratio, WithinRel(0.5, ratio));
  }
}

TEST_CASE("a step comes out as the exact exponential, whatever the frames", "[effects][property]") {
  const double tau = 0.3;
  const std::vector<double> times =
      GENERATE(std::vector<double>{0.0, 0.1, 0.5, 2.0}, std::vector<double>{0.0, 2.0},
               std::vector<double>{0.0, 1e-7, 0.1, 0.1001, 0.5, 1.0, 2.0});
  const std::vector<double> out = response(tau, times, [](double) { return 5.0; });
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(out[i], WithinAbs(-5.0 * std::expm1(-times[i] / tau), 1e-14));
}

TEST_CASE("a ramp comes out as the exact response, from rest or over a corner",
          "[effects][property]") {
  const double tau = 0.25;
  // tau v' = t - v: v = t - tau (1 - exp(-t/tau))
  for (const double t : {0.05, 0.4, 3.0})
    CHECK_THAT(response(tau, {0.0, t}, [](double s) { return s; }).back(),
               WithinAbs(t + tau * std::expm1(-t / tau), 1e-15));
  // The ramp ends at 1: the rest of the lag dies away.
  const auto corner = [](double s) { return s < 1.0 ? s : 1.0; };
  const double at_corner = 1.0 + tau * std::expm1(-1.0 / tau);
  CHECK_THAT(response(tau, {0.0, 0.3, 1.0, 1.7}, corner).back(),
             WithinAbs(1.0 + (at_corner - 1.0) * std::exp(-0.7 / tau), 1e-14));
}

TEST_CASE("at the cutoff frequency half of the power is left", "[effects]") {
  const double cutoff = 2.0;
  const double tau = 1.0 / (2.0 * std::numbers::pi * cutoff);
  std::vector<double> times;
  for (int i = 0; i <= 40000; ++i) times.push_back(i * 1e-4);
  const std::vector<double> out =
      response(tau, times, [&](double t) { return std::sin(2.0 * std::numbers::pi * cutoff * t); });
  double power = 0.0;
  for (std::size_t i = 20001; i < out.size(); ++i) power += out[i] * out[i] / 20000.0;
  CHECK_THAT(power, WithinRel(0.25, 1e-4));  // of 0.5
}

TEST_CASE("a sensor at rest stays at rest", "[effects]") {
  const auto stage = make_effect(LowPass{0.1}, two_taxels);
  std::vector<double> rest{0.25, -0.5};  // offsets
  stage->rest(rest);
  CHECK(rest == std::vector{0.25, -0.5});
  for (const double since : {0.0, 0.01, 1.0}) {
    std::vector<double> readings{0.25, -0.5};
    stage->apply({.since = since}, readings);
    CHECK_THAT(readings[0], WithinRel(0.25, 1e-15));
    CHECK_THAT(readings[1], WithinRel(-0.5, 1e-15));
  }
}
