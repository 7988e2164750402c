#include "tactile_net/sensing/effects/sampling.hpp"

#include <vector>

#include "tests/catch.hpp"
#include "tests/sensing/effects/two_taxels.hpp"

using namespace tactile_net;

namespace {

struct Point {
  double time;
  double value;
  bool recorded;
  bool opens;
};

std::vector<double> frames(double aperture, const std::vector<Point>& points) {
  const auto stage = make_effect(Sampling{aperture}, two_taxels);
  std::vector<double> rest(2);
  stage->rest(rest);
  std::vector<double> out;
  double before = 0.0;
  for (const auto& [time, value, recorded, opens] : points) {
    std::vector<double> readings(2, value);
    stage->apply({.time = time, .since = time - before, .recorded = recorded, .opens = opens},
                 readings);
    if (recorded) out.push_back(readings[1]);
    before = time;
  }
  return out;
}

}  // namespace

TEST_CASE("a frame is the mean over its window, not before it", "[effects]") {
  // A ramp of slope 2; the window of 0.25 before t = 1 has its middle at 0.875.
  const auto out =
      frames(0.25, {{0.0, 0.0, true, false}, {0.75, 1.5, false, true}, {1.0, 2.0, true, false}});
  CHECK(out == std::vector{0.0, 1.75});
}

TEST_CASE("the pieces of a window weigh as long as they last", "[effects]") {
  // 0 until 0.8, up to 1 until 0.9, then 1: the mean over the last 0.5 is (0.05 + 0.1) / 0.5.
  const auto out = frames(0.5, {{0.0, 0.0, true, false},
                                {0.5, 0.0, false, true},
                                {0.8, 0.0, false, false},
                                {0.9, 1.0, false, false},
                                {1.0, 1.0, true, false}});
  CHECK_THAT(out.back(), WithinRel(0.3, 1e-14));
}

TEST_CASE("windows that touch share nothing, and a load at t = 0 has not acted yet", "[effects]") {
  const auto out =
      frames(1.0, {{0.0, 4.0, true, true}, {1.0, 4.0, true, true}, {2.0, 0.0, true, true}});
  CHECK(out == std::vector{0.0, 4.0, 2.0});
}
