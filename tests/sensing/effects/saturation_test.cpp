#include "tactile_net/sensing/effects/saturation.hpp"

#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("readings end at their quantity's range, and the frame says how many do", "[effects]") {
  const SensorArray array{3, 1.0, {1.0}, {Quantity::stress_x, Quantity::strain_x}};
  const auto stage = make_effect(
      Saturation{{{Quantity::stress_x, {-1.0, 2.0}}, {Quantity::strain_x, {0.0, 0.5}}}}, array);
  std::vector<double> readings{-3.0, 1.0, 2.5, -0.1, 0.25, 0.5};
  stage->apply({}, readings);
  CHECK(readings == std::vector{-1.0, 1.0, 2.0, 0.0, 0.25, 0.5});
  const auto note = stage->note();
  REQUIRE(note);
  CHECK(note->effect == "saturation");
  CHECK(note->cut_off == 3);
  CHECK(note->readings == 6);
  stage->apply({}, readings);  // what is at the end is not beyond it
  CHECK_FALSE(stage->note());
}
