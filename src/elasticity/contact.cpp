#include "tactile_net/elasticity/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "numeric/require.hpp"

namespace tactile_net {

namespace {

using std::numbers::pi;

// Rigid indenters. u = (y - center) / half_width throughout.

double load(const RigidContact& contact, Traction component) noexcept {
  return component == Traction::normal ? contact.force : contact.friction * contact.force;
}

Interval support(const RigidContact& contact) noexcept {
  return {contact.center - contact.half_width, contact.center + contact.half_width};
}

/// The ends as `support` rounds them are exactly -1 and 1, so that a singular edge is found there.
double relative_position(const RigidContact& contact, double y) noexcept {
  const auto [from, to] = support(contact);
  if (y == from) return -1.0;
  if (y == to) return 1.0;
  return (y - contact.center) / contact.half_width;
}

/// sqrt(1 - u^2), accurate near the edges; |u| <= 1.
double ellipse(double u) noexcept { return std::sqrt((1.0 - u) * (1.0 + u)); }

/// arccosh(1 / |u|), for u = 0 too, where it is infinite.
double arccosh_inverse(double u) noexcept { return std::log1p(ellipse(u)) - std::log(std::abs(u)); }

/// a / (a + e): the punch is cut from a singular one that is wider by this.
double cut(const RigidContact& contact) noexcept {
  return contact.half_width / (contact.half_width + contact.edge);
}

double traction(const RigidContact& contact, Traction component, double y) noexcept {
  const double u = relative_position(contact, y);
  const double force = load(contact, component);
  if (!(std::abs(u) <= 1.0) || force == 0.0) return 0.0;

  const double a = contact.half_width;
  switch (contact.shape) {
    case Shape::cylinder:
      return 2.0 * force / (pi * a) * ellipse(u);
    case Shape::punch:
      return force / (pi * (a + contact.edge)) / ellipse(cut(contact) * u);
    case Shape::wedge:
      return force / (pi * a) * arccosh_inverse(u);
  }
  return 0.0;
}

/// The force between the centre and u, odd in u, per unit of `force`.
double force_share(const RigidContact& contact, double u) noexcept {
  u = std::clamp(u, -1.0, 1.0);
  switch (contact.shape) {
    case Shape::cylinder:
      return (std::asin(u) + u * ellipse(u)) / pi;
    case Shape::punch:
      return std::asin(cut(contact) * u) / pi;
    case Shape::wedge:
      return u == 0.0 ? 0.0 : (u * arccosh_inverse(u) + std::asin(u)) / pi;
  }
  return 0.0;
}

double force_between(const RigidContact& contact, Traction component, double from,
                     double to) noexcept {
  return load(contact, component) * (force_share(contact, relative_position(contact, to)) -
                                     force_share(contact, relative_position(contact, from)));
}

void check(const RigidContact& contact) {
  require_finite("center", contact.center);
  require_positive("half_width", contact.half_width);
  require_finite("force", contact.force);
  require_finite("edge", contact.edge);
  require(contact.edge >= 0.0, "edge", "be >= 0", contact.edge);
  require_finite("friction", contact.friction);
}

std::vector<double> singular_points(const RigidContact& contact) {
  if (contact.shape == Shape::wedge) return {contact.center};
  if (contact.shape == Shape::punch && contact.edge == 0.0) {
    const auto [from, to] = support(contact);
    return {from, to};
  }
  return {};
}

bool has_friction(const RigidContact& contact) noexcept {
  return contact.friction != 0.0 && contact.force != 0.0;
}

// Sampled tractions. u = (y - first) / pitch throughout: value i stands at u = i.

const std::vector<double>& values(const SampledTractions& contact, Traction component) noexcept {
  return component == Traction::normal ? contact.normal : contact.tangential;
}

/// Value i, zero before the first and after the last.
double value(const std::vector<double>& values, double i) noexcept {
  return i < 0.0 || i >= static_cast<double>(values.size()) ? 0.0
                                                            : values[static_cast<std::size_t>(i)];
}

Interval support(const SampledTractions& contact) noexcept {
  const auto count = static_cast<double>(contact.normal.size());
  return {contact.first - contact.pitch, contact.first + count * contact.pitch};
}

double relative_position(const SampledTractions& contact, double y) noexcept {
  return (y - contact.first) / contact.pitch;
}

/// A point that is the place of a value but for rounding has exactly that value.
double traction(const SampledTractions& contact, Traction component, double y) noexcept {
  const std::vector<double>& f = values(contact, component);
  const double u = relative_position(contact, y);
  if (!(u > -1.0 && u < static_cast<double>(f.size()))) return 0.0;

  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() *
                          (std::abs(y / contact.pitch) + std::abs(contact.first / contact.pitch));
  const double nearest = std::round(u);
  if (std::abs(u - nearest) <= rounding) return value(f, nearest);

  const double i = std::floor(u);
  return std::lerp(value(f, i), value(f, i + 1.0), u - i);
}

/// The force before u: every value's share is the integral of its hat function.
double force_before(const SampledTractions& contact, Traction component, double u) noexcept {
  const std::vector<double>& f = values(contact, component);
  u = std::clamp(u, -1.0, static_cast<double>(f.size()));
  const double i = std::floor(u);
  const double w = u - i;
  double sum = 0.0;
  for (std::size_t j = 0; static_cast<double>(j) < i; ++j) sum += value(f, static_cast<double>(j));
  sum += 0.5 * value(f, i) + w * (value(f, i) + 0.5 * w * (value(f, i + 1.0) - value(f, i)));
  return contact.pitch * sum;
}

double force_between(const SampledTractions& contact, Traction component, double from,
                     double to) noexcept {
  return force_before(contact, component, relative_position(contact, to)) -
         force_before(contact, component, relative_position(contact, from));
}

void check(const SampledTractions& contact) {
  require_finite("first", contact.first);
  require_positive("pitch", contact.pitch);
  if (contact.normal.empty()) throw std::invalid_argument("normal must hold at least one value");
  if (!contact.tangential.empty())
    require(contact.tangential.size() == contact.normal.size(), "tangential",
            "hold as many values as normal, " + std::to_string(contact.normal.size()),
            contact.tangential.size());
  for (std::size_t i = 0; i < contact.normal.size(); ++i)
    require_finite("normal[" + std::to_string(i) + "]", contact.normal[i]);
  for (std::size_t i = 0; i < contact.tangential.size(); ++i)
    require_finite("tangential[" + std::to_string(i) + "]", contact.tangential[i]);
}

std::vector<double> singular_points(const SampledTractions&) { return {}; }

bool has_friction(const SampledTractions& contact) noexcept {
  return std::any_of(contact.tangential.begin(), contact.tangential.end(),
                     [](double value) { return value != 0.0; });
}

}  // namespace

void check(const Contact& contact) {
  std::visit([](const auto& c) { check(c); }, contact);
}

double traction(const Contact& contact, Traction component, double y) noexcept {
  if (component == Traction::tangential_z) return 0.0;
  return std::visit([&](const auto& c) { return traction(c, component, y); }, contact);
}

double force_between(const Contact& contact, Traction component, double from, double to) noexcept {
  if (component == Traction::tangential_z) return 0.0;
  return std::visit([&](const auto& c) { return force_between(c, component, from, to); }, contact);
}

double resultant(const Contact& contact, Traction component) noexcept {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return force_between(contact, component, -infinity, infinity);
}

Interval support(const Contact& contact) noexcept {
  return std::visit([](const auto& c) { return support(c); }, contact);
}

std::vector<double> singular_points(const Contact& contact) {
  return std::visit([](const auto& c) { return singular_points(c); }, contact);
}

bool has_friction(const Contact& contact) noexcept {
  return std::visit([](const auto& c) { return has_friction(c); }, contact);
}

}  // namespace tactile_net
