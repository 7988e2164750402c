#include "tactile_net/sensing/effects/hysteresis.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "tests/catch.hpp"
#include "tests/sensing/effects/two_taxels.hpp"

using namespace tactile_net;

namespace {

const Hysteresis three{.thresholds = {{Quantity::stress_x, {0.25, 0.5, 1.0}}},
                       .weights = {0.25, 0.125, 0.5}};

/// A new sensor's answer to values of the input, one after another.
std::vector<double> answer(const Hysteresis& hysteresis, const std::vector<double>& inputs) {
  const auto stage = make_effect(hysteresis, two_taxels);
  std::vector<double> out;
  for (const double in : inputs) {
    std::vector<double> readings{in, 0.0};
    stage->apply({}, readings);
    out.push_back(readings[0]);
  }
  return out;
}

/// Many small steps from value to value.
std::vector<double> slowly(const std::vector<double>& values, int steps) {
  std::vector<double> path{values.front()};
  for (std::size_t i = 1; i < values.size(); ++i)
    for (int k = 1; k <= steps; ++k)
      path.push_back(values[i - 1] + (values[i] - values[i - 1]) * k / steps);
  return path;
}

}  // namespace

TEST_CASE("one play operator: the answer by hand", "[effects]") {
  const Hysteresis one{.thresholds = {{Quantity::stress_x, {1.0}}}, .weights = {0.5}};
  // The play: 0, 2, 2 (stands still), 0 (follows), 0, 1.
  CHECK(answer(one, {0.5, 3.0, 1.5, -1.0, 0.5, 2.0}) ==
        std::vector{0.25, 2.5, 1.75, -0.5, 0.25, 1.5});
}

TEST_CASE("hysteresis does not know how fast the load came", "[effects][property]") {
  const std::vector<double> turns{0.0, 2.0, -1.0, 1.5, 0.25, 3.0, -3.0};
  const double fast = answer(three, turns).back();
  for (const int steps : {2, 7, 1000})
    CHECK_THAT(answer(three, slowly(turns, steps)).back(), WithinAbs(fast, 1e-14));
}

TEST_CASE("minor loops close and are forgotten: Madelung's rules", "[effects][property]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  for (int trial = 0; trial < 200; ++trial) {
    // Up to the turning point a, back to b, and back to a: the loop closes at a, whatever the past.
    std::vector<double> past{0.0, uniform(random), uniform(random)};
    const double a = 3.5;
    const double b = uniform(random);
    past.push_back(a);
    std::vector<double> with_loop = past;
    with_loop.insert(with_loop.end(), {b, a});
    CHECK_THAT(answer(three, with_loop).back(), WithinAbs(answer(three, past).back(), 1e-14));
    // Beyond a all goes on as if the loop had never been.
    for (const double next : {4.0, -2.0, 0.5}) {
      past.push_back(next);
      with_loop.push_back(next);
      CHECK_THAT(answer(three, with_loop).back(), WithinAbs(answer(three, past).back(), 1e-14));
    }
  }
}

TEST_CASE("loops between the same two loads are congruent, and as wide as the weights say",
          "[effects][property]") {
  // Widths between branches after two different pasts.
  const auto loop = [](double past) {
    const std::vector<double> out = answer(three, {past, -4.0, 4.0, 0.0, -4.0, 0.0});
    return out[3] - out[5];  // coming down to 0 less coming up to 0
  };
  const double width = 2.0 * (0.25 * 0.25 + 0.125 * 0.5 + 0.5 * 1.0);
  CHECK_THAT(loop(0.0), WithinAbs(width, 1e-15));
  CHECK_THAT(loop(7.0), WithinAbs(width, 1e-15));
}

TEST_CASE("within its thresholds a play stands still, beyond them it follows", "[effects]") {
  // Of what goes in, 1 - sum of weights comes out.
  CHECK(answer(three, {0.25, -0.125, 0.0625}) ==
        std::vector{0.25 * 0.125, -0.125 * 0.125, 0.0625 * 0.125});
  const double far = answer(three, {100.0}).back();
  CHECK_THAT(far, WithinRel(100.0 - (0.25 * 0.25 + 0.125 * 0.5 + 0.5), 1e-15));
}
