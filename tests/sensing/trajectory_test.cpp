#include "tactile_net/sensing/moving_contact.hpp"
#include "tactile_net/sensing/piecewise_linear.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("between knots a value is on the straight line, beyond them as at the end", "[time]") {
  const PiecewiseLinear line{{1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}};
  CHECK(line(-5.0) == 10.0);
  CHECK(line(1.0) == 10.0);
  CHECK(line(1.5) == 15.0);
  CHECK(line(2.0) == 20.0);
  CHECK(line(3.5) == 5.0);
  CHECK(line(4.0) == 0.0);
  CHECK(line(9.0) == 0.0);
  CHECK(PiecewiseLinear{{3.0}, {7.0}}(1.0) == 7.0);
}

TEST_CASE("a contact's place, width, force and friction move, its shape does not", "[time]") {
  const ContactTrajectory trajectory{
      {1.0, {.shape = Shape::punch, .center = -1, .half_width = 2, .force = 0, .edge = 0.5}},
      {3.0,
       {.shape = Shape::punch,
        .center = 3,
        .half_width = 4,
        .force = 8,
        .edge = 0.5,
        .friction = 1}}};
  const RigidContact half = contact_at(trajectory, 2.0);
  CHECK(half.shape == Shape::punch);
  CHECK(half.center == 1.0);
  CHECK(half.half_width == 3.0);
  CHECK(half.force == 4.0);
  CHECK(half.edge == 0.5);
  CHECK(half.friction == 0.5);
  CHECK(contact_at(trajectory, 0.0).force == 0.0);
  CHECK(contact_at(trajectory, 3.0).center == 3.0);
  CHECK(contact_at(trajectory, 99.0).half_width == 4.0);
}
