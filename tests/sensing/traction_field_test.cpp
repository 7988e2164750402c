#include "tactile_net/sensing/traction_field.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

SensorArray line(std::size_t count, double pitch) {
  return {.count = count, .pitch = pitch, .depths = {1.0}, .reads = {Quantity::stress_x}};
}

double force(const std::vector<double>& field, double pitch) {
  return pitch * std::accumulate(field.begin(), field.end(), 0.0);
}

}  // namespace

TEST_CASE("no contact is a field of zeros", "[traction_field]") {
  const TractionField field = sample({}, line(5, 0.5));
  CHECK(field.normal == std::vector<double>(5));
  CHECK(field.tangential.empty());
}

TEST_CASE("a smooth contact is sampled point by point", "[traction_field]") {
  const Contact contact = RigidContact{.center = 0.1, .half_width = 2.0, .friction = 0.5};
  const SensorArray array = line(21, 0.25);
  const TractionField field = sample(std::vector{contact}, array);
  REQUIRE(field.tangential.size() == 21);
  for (std::size_t j = 0; j < array.count; ++j) {
    CHECK(field.normal[j] == traction(contact, Traction::normal, position(array, j)));
    CHECK(field.tangential[j] == traction(contact, Traction::tangential_y, position(array, j)));
  }
}

TEST_CASE("a cell with an infinite traction holds its mean, which is the force in it",
          "[traction_field]") {
  const Shape shape = GENERATE(Shape::punch, Shape::wedge);
  const RigidContact contact{.shape = shape, .half_width = 2.0, .friction = 0.25};
  const SensorArray array = line(21, 0.25);
  const TractionField field = sample(std::vector<Contact>{contact}, array);
  for (std::size_t j = 0; j < array.count; ++j) {
    const double y = position(array, j);
    const bool infinite =
        shape == Shape::punch ? std::abs(std::abs(y) - 2.0) < 0.125 : std::abs(y) < 0.125;
    const double expected =
        infinite ? force_between(contact, Traction::normal, y - 0.125, y + 0.125) / 0.25
                 : traction(contact, Traction::normal, y);
    CAPTURE(y);
    CHECK(field.normal[j] == expected);
    CHECK_THAT(field.tangential[j], WithinRel(0.25 * expected, 1e-15));
    CHECK(std::isfinite(field.normal[j]));
  }
}

TEST_CASE("the samples carry the load, the better the finer they are",
          "[traction_field][property]") {
  const Shape shape = GENERATE(Shape::cylinder, Shape::punch, Shape::wedge);
  const std::vector<Contact> contacts{RigidContact{.shape = shape, .half_width = 1.0}};
  double before = 0.2;
  for (const double pitch : {0.1, 0.01, 0.001}) {
    const auto count = static_cast<std::size_t>(std::lround(3.0 / pitch)) + 1;
    const double error = std::abs(force(sample(contacts, line(count, pitch)).normal, pitch) - 1.0);
    CAPTURE(static_cast<int>(shape), pitch);
    CHECK(error < 0.5 * before);
    before = error;
  }
}

TEST_CASE("an infinite point on the border of two cells is in both, in any unit",
          "[traction_field][property]") {
  // Cells end at multiples of the pitch when the count is even; so do the punch's edges.
  const double metre = GENERATE(1.0, 1e-3, 0.1, 1.0 / 3.0, 1e-120);
  CAPTURE(metre);
  const RigidContact punch{.shape = Shape::punch, .half_width = 3.0 * metre, .force = metre};
  const auto field = sample(std::vector<Contact>{punch}, line(10, metre)).normal;
  const RigidContact unit{.shape = Shape::punch, .half_width = 3.0};
  // Next to the edge a rounded place of 1e-16 is a force of its root.
  CHECK_THAT(field[1], WithinAbs(0.0, 1e-7));  // the mean over a cell that the edge only touches
  CHECK_THAT(field[2], WithinRel(force_between(unit, Traction::normal, -3.0, -2.0), 1e-7));
  CHECK_THAT(field[3], WithinRel(traction(unit, Traction::normal, -1.5), 1e-13));
  CHECK_THAT(field[7], WithinRel(field[2], 1e-7));
}

TEST_CASE("contacts add up", "[traction_field][property]") {
  const Contact left = RigidContact{.shape = Shape::wedge, .center = -1.0, .friction = 0.3};
  const Contact right = RigidContact{.center = 0.7, .half_width = 1.5, .force = 4.0};
  const SensorArray array = line(16, 0.3);
  const TractionField one = sample(std::vector{left}, array);
  const TractionField two = sample(std::vector{right}, array);
  const TractionField both = sample(std::vector{left, right}, array);
  CHECK(two.tangential.empty());
  CHECK(both.tangential == one.tangential);
  for (std::size_t j = 0; j < array.count; ++j)
    CHECK(both.normal[j] == one.normal[j] + two.normal[j]);
}

TEST_CASE("values given at the taxels are the field, to the bit", "[traction_field]") {
  const SensorArray array = line(7, 0.1);
  const SampledTractions given{.first = position(array, 0),
                               .pitch = array.pitch,
                               .normal = {0.0, 1.0, 0.0, 0.3, 0.0, 0.0, 7.0},
                               .tangential = {0.0, 0.1, 0.0, 0.0, -0.2, 0.0, 0.0}};
  const TractionField field = sample(std::vector<Contact>{given}, array);
  CHECK(field.normal == given.normal);
  CHECK(field.tangential == given.tangential);
}

TEST_CASE("a field is not made of an array or a contact out of range", "[traction_field]") {
  const std::vector<Contact> bad{RigidContact{.half_width = 0.0}};
  CHECK_THROWS_AS(sample({}, line(1, 0.5)), std::invalid_argument);
  CHECK_THROWS_AS(sample(bad, line(5, 0.5)), std::invalid_argument);
}
