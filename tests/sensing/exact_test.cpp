#include "tactile_net/sensing/exact.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/sensing/bumps.hpp"
#include "tests/sensing/pad.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

// The independent way: with w = y + i depth and the Cauchy transform C(w), the integral of
// f(s) / (w - s) ds, every stress is a real or imaginary part of C and depth * C' (Muskhelishvili).
// C is elementary for all the profiles but a punch with an edge.

struct Cauchy {
  Complex c;           ///< C(w)
  Complex derivative;  ///< C'(w)
};

Cauchy cauchy(const RigidContact& contact, Complex w) {
  w -= contact.center;
  const double a = contact.half_width;
  const double p = contact.force;
  const Complex root = std::sqrt(w - a) * std::sqrt(w + a);
  switch (contact.shape) {
    case Shape::cylinder:  // 2 P / a^2 (w - root)
      return {2.0 * p / (w + root), -2.0 * p / (root * (w + root))};
    case Shape::punch:
      return {p / root, -p * w / (root * root * root)};
    case Shape::wedge:
      return {p / a * std::asin(a / w), -p / (w * root)};
  }
  return {};
}

Cauchy cauchy(const SampledTractions& contact, Traction component, Complex w) {
  const auto& f = component == Traction::normal ? contact.normal : contact.tangential;
  Cauchy sum{};
  for (std::size_t i = 0; i <= f.size(); ++i) {
    const double from = i == 0 ? 0.0 : f[i - 1];
    const double to = i == f.size() ? 0.0 : f[i];
    const double s = contact.first + (static_cast<double>(i) - 1.0) * contact.pitch;
    const double slope = (to - from) / contact.pitch;
    const Complex logarithm = std::log(w - s) - std::log(w - s - contact.pitch);
    sum.c += (from + slope * (w - s)) * logarithm - slope * contact.pitch;
    sum.derivative += slope * logarithm;  // C' is the transform of f'
  }
  return sum;
}

double stress(Quantity quantity, const Cauchy& normal, const Cauchy& tangential, double depth) {
  const Complex n = depth * normal.derivative;
  const Complex t = depth * tangential.derivative;
  switch (quantity) {
    case Quantity::stress_x:
      return (-normal.c.imag() + n.real() + t.imag()) / pi;
    case Quantity::stress_y:
      return (-normal.c.imag() - n.real() + 2.0 * tangential.c.real() - t.imag()) / pi;
    default:
      return (n.imag() - tangential.c.imag() - t.real()) / pi;
  }
}

double closed_form(const Channel& channel, const Material& material, const Contact& contact,
                   double y) {
  const Complex w{y, channel.depth};
  Cauchy normal;
  Cauchy tangential;
  if (const auto* rigid = std::get_if<RigidContact>(&contact)) {
    normal = cauchy(*rigid, w);
    tangential = {rigid->friction * normal.c, rigid->friction * normal.derivative};
  } else {
    normal = cauchy(std::get<SampledTractions>(contact), Traction::normal, w);
    tangential = cauchy(std::get<SampledTractions>(contact), Traction::tangential_y, w);
  }
  const auto read = [&](Quantity quantity) {
    return stress(quantity, normal, tangential, channel.depth);
  };
  if (!is_strain(channel.quantity)) return read(channel.quantity);
  const bool x = channel.quantity == Quantity::strain_x;
  const double nu = material.poisson_ratio;
  const double along = read(x ? Quantity::stress_x : Quantity::stress_y);
  const double across = read(x ? Quantity::stress_y : Quantity::stress_x);
  return ((1.0 - nu * nu) * along - nu * (1.0 + nu) * across) / material.youngs_modulus;
}

SensorArray line(std::size_t count, double pitch, std::vector<double> depths) {
  return {.count = count,
          .pitch = pitch,
          .depths = std::move(depths),
          .reads = {line_quantities.begin(), line_quantities.end()}};
}

/// Largest deviation of any channel from the closed form, in units of the channel's peak.
double deviation(const SensorArray& array, const Contact& contact) {
  const auto readings = exact_readings(array, pad, std::vector{contact});
  double worst = 0.0;
  auto block = std::span(readings);
  for (const Channel& channel : channels(array)) {
    const auto values = block.first(array.count);
    block = block.subspan(array.count);
    double error = 0.0;
    for (std::size_t j = 0; j < array.count; ++j)
      error = std::max(
          error, std::abs(values[j] - closed_form(channel, pad, contact, position(array, j))));
    worst = std::max(worst, error / peak(values));
  }
  return worst;
}

}  // namespace

TEST_CASE("on the axis of a cylinder the stress is McEwen's", "[exact]") {
  const double depth = GENERATE(0.005, 0.02, 0.3, 1.5, 40.0);
  CAPTURE(depth);
  SensorArray array = line(3, 0.5, {depth});
  array.reads = {Quantity::stress_x};
  const RigidContact cylinder{.half_width = 2.0, .force = 5.0};
  const double p0 = 2.0 * 5.0 / (pi * 2.0);
  const auto readings = exact_readings(array, pad, std::vector<Contact>{cylinder});
  CHECK_THAT(readings[1], WithinRel(p0 / std::hypot(1.0, depth / 2.0), 1e-13));
}

TEST_CASE("indenters are read as the complex potential says, deep and shallow", "[exact]") {
  const Shape shape = GENERATE(Shape::cylinder, Shape::punch, Shape::wedge);
  const double friction = GENERATE(0.0, 0.7);
  CAPTURE(static_cast<int>(shape), friction);
  const RigidContact contact{
      .shape = shape, .center = 0.13, .half_width = 2.0, .force = 3.0, .friction = friction};
  CHECK(deviation(line(25, 0.25, {0.002, 0.01, 0.1, 1.5, 20.0}), contact) < 1e-11);
}

TEST_CASE("taxels right below a singular point are as exact as the others", "[exact]") {
  const Shape shape = GENERATE(Shape::punch, Shape::wedge);
  const double friction = GENERATE(0.0, -0.3);
  const RigidContact contact{.shape = shape, .half_width = 2.0, .friction = friction};
  CHECK(deviation(line(9, 0.5, {2e-3, 0.05, 1.0}), contact) < 1e-10);
}

TEST_CASE("the array may lie far beside the contact", "[exact]") {
  const Shape shape = GENERATE(Shape::cylinder, Shape::punch, Shape::wedge);
  const RigidContact contact{.shape = shape, .center = 30.0, .friction = 0.2};
  CHECK(deviation(line(7, 0.5, {0.5, 2.0}), contact) < 1e-11);
}

TEST_CASE("piecewise linear tractions are read as their logarithms say", "[exact]") {
  CHECK(deviation(line(15, 0.3, {0.004, 0.1, 1.0, 5.0}), bumps) < 1e-11);
}

TEST_CASE("a punch with an edge is read as its own potential says", "[exact]") {
  // C(w) of P / (pi sqrt(b^2 - s^2)) cut off at |s| = a < b, with s = b sin t: the integral of
  // P / pi dt / (w - b sin t) is elementary. C' by differences of order h^4.
  const RigidContact blunt{.shape = Shape::punch, .half_width = 1.5, .edge = 0.5, .friction = 0.4};
  const auto transform = [](Complex w) {
    const double b = 2.0;
    const Complex root = std::sqrt(w - b) * std::sqrt(w + b);
    const auto primitive = [&](double t) {
      return 2.0 / root * std::atan((w * std::tan(0.5 * t) - b) / root);
    };
    const double end = std::asin(1.5 / b);
    return (primitive(end) - primitive(-end)) / pi;
  };
  SensorArray array = line(9, 0.5, {0.05, 0.8});
  array.reads = {Quantity::stress_x, Quantity::stress_y, Quantity::shear_xy};
  const auto readings = exact_readings(array, pad, std::vector<Contact>{blunt});
  auto reading = readings.begin();
  for (const Channel& channel : channels(array))
    for (std::size_t j = 0; j < array.count; ++j) {
      const Complex w{position(array, j), channel.depth};
      const double h = 1e-3 * channel.depth;
      const Complex derivative = (8.0 * (transform(w + h) - transform(w - h)) -
                                  (transform(w + 2.0 * h) - transform(w - 2.0 * h))) /
                                 (12.0 * h);
      const Cauchy normal{transform(w), derivative};
      const Cauchy tangential{0.4 * normal.c, 0.4 * derivative};
      CAPTURE(channel.name, j);
      CHECK_THAT(*reading++,
                 WithinAbs(stress(channel.quantity, normal, tangential, channel.depth), 1e-11));
    }
}

TEST_CASE("a punch with a vanishing edge is the sharp one", "[exact][property]") {
  const SensorArray array = line(9, 0.5, {0.8});
  const RigidContact sharp{.shape = Shape::punch, .half_width = 1.5};
  RigidContact blunt = sharp;
  blunt.edge = 1e-16;
  const auto a = exact_readings(array, pad, std::vector<Contact>{sharp});
  const auto b = exact_readings(array, pad, std::vector<Contact>{blunt});
  for (std::size_t i = 0; i < a.size(); ++i) CHECK_THAT(b[i], WithinAbs(a[i], 1e-7));
}

TEST_CASE("the discrete sum tends to the integral as the pitch does to zero",
          "[exact][sampled][property]") {
  const auto error = [](const Contact& contact, std::size_t count, double pitch) {
    const SensorArray array = line(count, pitch, {0.5});
    const std::vector contacts{contact};
    const auto exact = exact_readings(array, pad, contacts);
    const auto sum = sampled_readings(array, pad, sample(contacts, array));
    double worst = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      worst = std::max(worst, std::abs(exact[i] - sum[i]));
    return worst;
  };
  const RigidContact cylinder{.friction = 0.5};
  CHECK(error(cylinder, 41, 0.1) < 1e-2);
  CHECK(error(cylinder, 401, 0.01) < 0.05 * error(cylinder, 41, 0.1));  // pitch^1.5 at the edges
  const RigidContact wedge{.shape = Shape::wedge, .friction = 0.5};
  CHECK(error(wedge, 401, 0.01) < 0.15 * error(wedge, 41, 0.1));
}

TEST_CASE("contacts add up in the exact readings", "[exact][property]") {
  const Contact left = RigidContact{.shape = Shape::wedge, .center = -1.0, .friction = 0.3};
  const Contact right = bumps;
  const SensorArray array = line(8, 0.5, {0.4, 1.0});
  const auto one = exact_readings(array, pad, std::vector{left});
  const auto two = exact_readings(array, pad, std::vector{right});
  const auto both = exact_readings(array, pad, std::vector{left, right});
  for (std::size_t i = 0; i < both.size(); ++i) CHECK(both[i] == one[i] + two[i]);
}

TEST_CASE("an unloaded pad reads zero", "[exact]") {
  const SensorArray array = line(4, 0.5, {1.0});
  CHECK(exact_readings(array, pad, {}) == std::vector<double>(5 * 4));
  const std::vector<Contact> idle{RigidContact{.force = 0.0},
                                  SampledTractions{.normal = {0.0, 0.0}, .tangential = {}}};
  CHECK(exact_readings(array, pad, idle) == std::vector<double>(5 * 4));
}

TEST_CASE("a mirrored contact is read mirrored", "[exact][property]") {
  const SensorArray array = line(12, 0.3, {0.6});
  const RigidContact right{.center = 0.4, .friction = 0.5};
  const RigidContact left{.center = -0.4, .friction = -0.5};
  const auto a = exact_readings(array, pad, std::vector<Contact>{right});
  const auto b = exact_readings(array, pad, std::vector<Contact>{left});
  std::size_t i = 0;
  for (const Quantity quantity : line_quantities)
    for (std::size_t j = 0; j < 12; ++j, ++i)
      CHECK_THAT(b[i], WithinAbs((quantity == Quantity::shear_xy ? -1.0 : 1.0) * a[i + 11 - 2 * j],
                                 1e-15));
}

TEST_CASE("units scale the exact readings and nothing else", "[exact][property]") {
  const Shape shape = GENERATE(Shape::cylinder, Shape::punch, Shape::wedge);
  const double metre = GENERATE(1e-3, 1e3, 1e-100);
  const double pascal = GENERATE(1.0, 1e6);
  const RigidContact contact{.shape = shape, .center = 0.1, .friction = 0.2};
  RigidContact scaled = contact;
  scaled.center *= metre;
  scaled.half_width *= metre;
  scaled.force *= metre * pascal;
  const Material stiff{.youngs_modulus = pad.youngs_modulus * pascal,
                       .poisson_ratio = pad.poisson_ratio};
  const auto before = exact_readings(line(7, 0.3, {0.2}), pad, std::vector<Contact>{contact});
  const auto after =
      exact_readings(line(7, 0.3 * metre, {0.2 * metre}), stiff, std::vector<Contact>{scaled});
  std::size_t i = 0;
  for (const Quantity quantity : line_quantities)
    for (std::size_t j = 0; j < 7; ++j, ++i)
      CHECK_THAT(after[i] / (is_strain(quantity) ? 1.0 : pascal), WithinAbs(before[i], 1e-13));
}

TEST_CASE("exact readings are not made of parts out of range", "[exact]") {
  const std::vector<Contact> good{RigidContact{}};
  const std::vector<Contact> bad{RigidContact{.edge = -1.0}};
  CHECK_THROWS_AS(exact_readings(line(1, 0.5, {1.0}), pad, good), std::invalid_argument);
  CHECK_THROWS_AS(exact_readings(line(3, 0.5, {1.0}), {.youngs_modulus = 0.0}, good),
                  std::invalid_argument);
  CHECK_THROWS_AS(exact_readings(line(3, 0.5, {1.0}), pad, bad), std::invalid_argument);
}

TEST_CASE("a reading is kept to 1e-10 of its channel's peak or refused", "[exact][property]") {
  const Shape shape = GENERATE(Shape::cylinder, Shape::punch, Shape::wedge);
  const double friction = GENERATE(0.0, -0.3);
  const double depth = GENERATE(1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 2e-3);
  CAPTURE(static_cast<int>(shape), friction, depth);
  const RigidContact contact{.shape = shape, .half_width = 2.0, .friction = friction};
  for (const Quantity quantity : line_quantities) {
    SensorArray array = line(9, 0.5, {depth});
    array.reads = {quantity};
    CAPTURE(name(quantity));
    double error = 0.0;
    bool refused = false;
    try {
      error = deviation(array, contact);
    } catch (const std::runtime_error&) {
      refused = true;
    }
    CHECK(error < 1e-10);
    CHECK_FALSE((refused && depth > 1e-4));
  }
}

TEST_CASE("readings that double precision cannot hold are refused, not made up", "[exact]") {
  // Under the middle of a wide contact the shear vanishes with the depth: what is left is the
  // difference of two halves, each 1e13 times larger.
  SensorArray array = line(3, 1e-3, {1e-12});
  array.reads = {Quantity::shear_xy};
  CHECK_THROWS_WITH(exact_readings(array, pad, std::vector<Contact>{RigidContact{}}),
                    StartsWith("shear_xy at depth 1e-12"));
}

TEST_CASE("taxels side by side below the middle of a contact read its shear's slope", "[exact]") {
  const RigidContact cylinder{.half_width = 2.0};
  const double apart = GENERATE(1e-6, 1e-9);
  const std::array places{-apart, 0.0, apart};
  const auto g =
      exact_readings(Channel{Quantity::shear_xy, 0.7}, places, pad, std::array{Contact{cylinder}});
  const double wide = 1e-3;
  const double slope =
      closed_form({Quantity::shear_xy, 0.7}, pad, cylinder, wide) / wide;  // to wide^2
  CHECK_THAT(g[2], WithinAbs(slope * apart, 1e-15 + 1e-5 * apart));
  CHECK_THAT(g[1], WithinAbs(0.0, 1e-15));
}

TEST_CASE("sampled tractions far away are read as the line loads they amount to", "[exact]") {
  const SensorArray array = line(3, 0.5, {0.5});
  SampledTractions away = bumps;
  away.first = 400.0;
  const auto readings = exact_readings(array, pad, std::array{Contact{away}});
  auto reading = readings.begin();
  for (const Channel& channel : channels(array))
    for (std::size_t j = 0; j < array.count; ++j) {
      double sum = 0.0;
      for (const Traction component : line_tractions) {
        const PadKernel kernel(channel.quantity, component, pad, channel.depth);
        const auto& values = component == Traction::normal ? away.normal : away.tangential;
        for (std::size_t i = 0; i < values.size(); ++i)
          sum += away.pitch * values[i] *
                 kernel(position(array, j) - away.first - static_cast<double>(i) * away.pitch);
      }
      CHECK_THAT(*reading++, WithinRel(sum, 1e-5));  // (pitch / distance)^2
    }
}

TEST_CASE("readings at any places are those of an array that lies there", "[exact][property]") {
  const std::array contacts{Contact{RigidContact{.center = 0.2, .friction = 0.3}}, Contact{bumps}};
  const SensorArray array = line(6, 0.4, {0.9});
  std::vector<double> places = positions(array);
  std::reverse(places.begin(), places.end());
  const auto all = exact_readings(array, pad, contacts);
  std::size_t block = 0;
  for (const Channel& channel : channels(array)) {
    auto readings = exact_readings(channel, places, pad, contacts);
    std::reverse(readings.begin(), readings.end());
    CHECK(std::equal(readings.begin(), readings.end(),
                     all.begin() + static_cast<std::ptrdiff_t>(block)));
    block += array.count;
  }
  const Material thin{.layer = Layer{0.5, Base::bonded}};
  CHECK_THROWS_WITH(exact_readings(channels(array)[0], places, thin, contacts),
                    StartsWith("depth must be at most the layer's thickness"));
}

TEST_CASE("more points and more halvings of a panel come closer to the integral", "[exact]") {
  const SensorArray array{
      .count = 21, .pitch = 0.5, .depths = {0.3}, .reads = {Quantity::strain_x}};
  const Material soft{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  const std::vector<Contact> contacts = {RigidContact{.shape = Shape::wedge, .half_width = 2.0}};
  const auto readings = [&](int points, int halvings) {
    constexpr double any = std::numeric_limits<double>::infinity();
    return exact_readings(array, soft, contacts, {points, halvings, any});
  };
  const std::vector<double> best = exact_readings(array, soft, contacts);
  const auto error = [&](const std::vector<double>& g) {
    double sum = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) sum = std::max(sum, std::abs(g[i] - best[i]));
    return sum;
  };
  CHECK(error(readings(15, 0)) > 1e-6);
  CHECK(error(readings(61, 0)) < 0.1 * error(readings(15, 0)));
  CHECK(error(readings(15, 3)) < 0.1 * error(readings(15, 0)));
  CHECK(error(readings(15, 16)) < 1e-12);
  CHECK_THROWS_AS(readings(16, 0), std::invalid_argument);
  CHECK_THROWS_AS(readings(15, -1), std::invalid_argument);
}
