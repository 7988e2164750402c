#include "tactile_net/elasticity/contact.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/catch.hpp"
#include "tests/not_finite.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

std::string refusal(const Contact& contact) {
  try {
    check(contact);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// The indenters, off centre; the punch with a sharp, a blunt and a very blunt edge.
RigidContact indenter(int i) {
  const RigidContact base{.center = 0.5, .half_width = 2.0, .force = 3.0, .friction = -0.4};
  RigidContact contact = base;
  if (i == 0) contact.shape = Shape::cylinder;
  if (i == 1) contact.shape = Shape::wedge;
  if (i >= 2) contact.shape = Shape::punch;
  if (i == 3) contact.edge = 0.01;
  if (i == 4) contact.edge = 5.0;
  return contact;
}

/// Integral of the traction between two points that enclose no singular point but as an end.
double integrated(const Contact& contact, Traction component, double from, double to) {
  static boost::math::quadrature::tanh_sinh<double> rule;
  return rule.integrate([&](double y) { return traction(contact, component, y); }, from, to);
}

const SampledTractions ramp{
    .first = -1.0, .pitch = 0.5, .normal = {2.0, 0.0, 5.0}, .tangential = {-1.0, 3.0, 0.0}};

}  // namespace

TEST_CASE("the force is the integral of the traction", "[contact][property]") {
  const RigidContact contact = indenter(GENERATE(0, 1, 2, 3, 4));
  const Traction component = GENERATE(Traction::normal, Traction::tangential_y);
  CAPTURE(static_cast<int>(contact.shape), contact.edge);
  const double borders[] = {-1.4, -0.3, 0.2, 0.5, 0.9, 2.4};
  for (int i = 0; i + 1 < 6; ++i) {
    CAPTURE(borders[i]);
    CHECK_THAT(force_between(contact, component, borders[i], borders[i + 1]),
               WithinRel(integrated(contact, component, borders[i], borders[i + 1]), 1e-12));
  }
}

TEST_CASE("the force between points is additive and ends with the contact", "[contact][property]") {
  const RigidContact contact = indenter(GENERATE(0, 1, 2, 3, 4));
  const auto force = [&](double from, double to) {
    return force_between(contact, Traction::normal, from, to);
  };
  const auto [from, to] = support(contact);
  CHECK(from == -1.5);
  CHECK(to == 2.5);
  CHECK_THAT(force(-1.0, 0.3) + force(0.3, 2.0), WithinRel(force(-1.0, 2.0), 1e-14));
  CHECK(force(from, to) == resultant(contact, Traction::normal));
  CHECK(force(-100.0, from) == 0.0);
  CHECK(force(to, infinite) == 0.0);
  CHECK(force(0.7, 0.7) == 0.0);
  CHECK_THAT(force(from, contact.center), WithinRel(force(contact.center, to), 1e-14));
}

TEST_CASE("the resultant is P, but for the part that an edge cuts away", "[contact]") {
  for (const int i : {0, 1, 2})
    CHECK_THAT(resultant(indenter(i), Traction::normal), WithinRel(3.0, 1e-15));
  for (const int i : {3, 4}) {
    const RigidContact punch = indenter(i);
    CHECK_THAT(resultant(punch, Traction::normal),
               WithinRel(3.0 * 2.0 / pi * std::asin(2.0 / (2.0 + punch.edge)), 1e-15));
  }
}

TEST_CASE("friction is the same fraction of the pressure everywhere", "[contact][property]") {
  const RigidContact contact = indenter(GENERATE(0, 1, 3));
  for (const double y : {-3.0, -1.2, 0.1, 0.6, 2.4})
    CHECK_THAT(traction(contact, Traction::tangential_y, y),
               WithinRel(-0.4 * traction(contact, Traction::normal, y), 1e-15));
  CHECK_THAT(resultant(contact, Traction::tangential_y),
             WithinRel(-0.4 * resultant(contact, Traction::normal), 1e-15));
}

TEST_CASE("profiles are symmetric about the centre and zero outside", "[contact][property]") {
  const RigidContact contact = indenter(GENERATE(0, 1, 2, 3, 4));
  for (const double t : {0.25, 1.0, 1.75})
    CHECK(traction(contact, Traction::normal, 0.5 - t) ==
          traction(contact, Traction::normal, 0.5 + t));
  for (const double y : {-infinite, -1.50001, 2.50001, 40.0, infinite, not_a_number})
    CHECK(traction(contact, Traction::normal, y) == 0.0);
}

TEST_CASE("profiles have their textbook peaks", "[contact]") {
  // Cylinder 2 P / (pi a), sharp punch P / (pi a) at the centre.
  CHECK_THAT(traction(indenter(0), Traction::normal, 0.5),
             WithinRel(2.0 * 3.0 / (pi * 2.0), 1e-15));
  CHECK_THAT(traction(indenter(2), Traction::normal, 0.5), WithinRel(3.0 / (pi * 2.0), 1e-15));
  CHECK_THAT(traction(indenter(1), Traction::normal, 1.5),
             WithinRel(3.0 / (pi * 2.0) * std::acosh(2.0), 1e-14));
}

TEST_CASE("the traction is infinite at the singular points and nowhere else", "[contact]") {
  CHECK(singular_points(indenter(0)).empty());
  CHECK(singular_points(indenter(1)) == std::vector{0.5});
  CHECK(singular_points(indenter(2)) == std::vector{-1.5, 2.5});
  CHECK(singular_points(indenter(3)).empty());
  CHECK(singular_points(ramp).empty());
  // Centres and widths whose ends are rounded.
  for (const double center : {0.0, 0.1, 0.3, -7.7, 1e9})
    for (const double half_width : {0.7, 1.1, 3.3})
      for (const Shape shape : {Shape::punch, Shape::wedge}) {
        const RigidContact contact{
            .shape = shape, .center = center, .half_width = half_width, .friction = -0.5};
        for (const double y : singular_points(contact)) {
          CHECK(traction(contact, Traction::normal, y) == infinite);
          CHECK(traction(contact, Traction::tangential_y, y) == -infinite);
        }
      }
}

TEST_CASE("no force is no traction, at singular points too", "[contact]") {
  const RigidContact idle{.shape = Shape::wedge, .force = 0.0, .friction = 0.5};
  CHECK(traction(idle, Traction::normal, 0.0) == 0.0);
  const RigidContact smooth{.shape = Shape::wedge};
  CHECK(traction(smooth, Traction::tangential_y, 0.0) == 0.0);
  CHECK_FALSE(has_friction(idle));
  CHECK_FALSE(has_friction(smooth));
  CHECK(has_friction(indenter(0)));
}

TEST_CASE("sampled tractions pass through their values", "[contact]") {
  CHECK(traction(ramp, Traction::normal, -1.0) == 2.0);
  CHECK(traction(ramp, Traction::normal, 0.0) == 5.0);
  CHECK(traction(ramp, Traction::tangential_y, -0.5) == 3.0);
  CHECK(traction(ramp, Traction::normal, -1.25) == 1.0);  // half way to nothing
  CHECK(traction(ramp, Traction::normal, -0.125) == 3.75);
  CHECK(traction(ramp, Traction::normal, 0.25) == 2.5);
  for (const double y : {-infinite, -1.5, 0.5, 9.0, infinite, not_a_number})
    CHECK(traction(ramp, Traction::normal, y) == 0.0);
}

TEST_CASE("a value comes back to the bit, however its place is rounded", "[contact]") {
  SampledTractions values{.first = -4.0 * 0.1, .pitch = 0.1, .normal = {}, .tangential = {}};
  for (int i = 0; i < 9; ++i) values.normal.push_back(i % 2 == 0 ? 0.0 : 1.0 / (1.0 + i));
  for (std::size_t i = 0; i < 9; ++i)
    CHECK(traction(values, Traction::normal, (static_cast<double>(i) - 4.0) * 0.1) ==
          values.normal[i]);
}

TEST_CASE("the resultant of sampled tractions is pitch times their sum", "[contact]") {
  CHECK_THAT(resultant(ramp, Traction::normal), WithinRel(0.5 * 7.0, 1e-15));
  CHECK_THAT(resultant(ramp, Traction::tangential_y), WithinRel(0.5 * 2.0, 1e-15));
  const auto [from, to] = support(ramp);
  CHECK(from == -1.5);
  CHECK(to == 0.5);
  CHECK_THAT(force_between(ramp, Traction::normal, from, to), WithinRel(3.5, 1e-15));
}

TEST_CASE("between two points sampled tractions add up their trapezoids", "[contact][property]") {
  // Trapezoids of a piecewise linear function are exact between its corners.
  for (const Traction component : {Traction::normal, Traction::tangential_y}) {
    const double borders[] = {-1.5, -1.3, -1.0, -0.8, -0.5, -0.2, 0.0, 0.1, 0.5};
    for (int i = 0; i + 1 < 9; ++i) {
      const double from = borders[i];
      const double to = borders[i + 1];
      CHECK_THAT(force_between(ramp, component, from, to),
                 WithinAbs(0.5 * (to - from) *
                               (traction(ramp, component, from) + traction(ramp, component, to)),
                           1e-15));
    }
  }
}

TEST_CASE("tangential values may be left out or be zero: no friction", "[contact]") {
  const SampledTractions normal_only{.normal = {1.0, 2.0}, .tangential = {}};
  CHECK_FALSE(has_friction(normal_only));
  CHECK(traction(normal_only, Traction::tangential_y, 0.5) == 0.0);
  CHECK(resultant(normal_only, Traction::tangential_y) == 0.0);
  CHECK_FALSE(has_friction(SampledTractions{.normal = {1.0, 2.0}, .tangential = {0.0, 0.0}}));
  CHECK(has_friction(ramp));
}

TEST_CASE("units of length and force scale tractions and forces", "[contact][property]") {
  const RigidContact contact = indenter(GENERATE(0, 1, 2, 3, 4));
  const double metre = GENERATE(1e-120, 1e-3, 1e120);
  const double newton = GENERATE(1e-6, 1e6);
  RigidContact scaled = contact;
  scaled.center *= metre;
  scaled.half_width *= metre;
  scaled.edge *= metre;
  scaled.force *= newton;
  CHECK_THAT(traction(scaled, Traction::normal, 0.9 * metre) * metre / newton,
             WithinRel(traction(contact, Traction::normal, 0.9), 1e-14));
  CHECK_THAT(force_between(scaled, Traction::normal, 0.1 * metre, 0.9 * metre) / newton,
             WithinRel(force_between(contact, Traction::normal, 0.1, 0.9), 1e-14));
}

TEST_CASE("a refusal names field, rule and value of a contact", "[contact]") {
  CHECK(refusal(RigidContact{}).empty());
  CHECK(refusal(RigidContact{.center = not_a_number}) == "center must be finite (got nan)");
  CHECK(refusal(RigidContact{.half_width = -1.0}) == "half_width must be > 0 (got -1)");
  CHECK(refusal(RigidContact{.half_width = 0.0}) == "half_width must be > 0 (got 0)");
  CHECK(refusal(RigidContact{.half_width = infinite}) == "half_width must be finite (got inf)");
  CHECK(refusal(RigidContact{.force = infinite}) == "force must be finite (got inf)");
  CHECK(refusal(RigidContact{.edge = -0.5}) == "edge must be >= 0 (got -0.5)");
  CHECK(refusal(RigidContact{.edge = not_a_number}) == "edge must be finite (got nan)");
  CHECK(refusal(RigidContact{.friction = not_a_number}) == "friction must be finite (got nan)");

  CHECK(refusal(ramp).empty());
  SampledTractions bad = ramp;
  bad.first = infinite;
  CHECK(refusal(bad) == "first must be finite (got inf)");
  bad = ramp;
  bad.pitch = 0.0;
  CHECK(refusal(bad) == "pitch must be > 0 (got 0)");
  bad = ramp;
  bad.tangential.pop_back();
  CHECK(refusal(bad) == "tangential must hold as many values as normal, 3 (got 2)");
  bad = ramp;
  bad.normal[1] = not_a_number;
  CHECK(refusal(bad) == "normal[1] must be finite (got nan)");
  bad = ramp;
  bad.tangential[2] = -infinite;
  CHECK(refusal(bad) == "tangential[2] must be finite (got -inf)");
  CHECK(refusal(SampledTractions{.normal = {}, .tangential = {}}) ==
        "normal must hold at least one value");
}
