#include "tactile_net/sensing/exact.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/elasticity/patch_kernel.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

namespace {

using std::numbers::pi;

constexpr double cancellation = 1e-12;  // of the parts' magnitude: readings below it are rounding

/// An integral, a bound of its error, and the integral of the integrand's magnitude.
struct Integral {
  double value = 0.0;
  double error = 0.0;
  double magnitude = 0.0;

  Integral& operator+=(const Integral& other) noexcept {
    value += other.value;
    error += other.error;
    magnitude += other.magnitude;
    return *this;
  }
};

/// One panel. Boost sees [-1, 1] alone, where its versions agree on the error's scale.
template <unsigned points>
Integral panel(const auto& integrand, double from, double to) {
  const double centre = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  Integral unit;
  unit.value = boost::math::quadrature::gauss_kronrod<double, points>::integrate(
      [&](double x) { return integrand(centre + half * x); }, -1.0, 1.0, 0, 0.0, &unit.error,
      &unit.magnitude);
  return {half * unit.value, half * unit.error, half * unit.magnitude};
}

Integral panel(const auto& integrand, double from, double to, int points) {
  switch (points) {
    case 15:
      return panel<15>(integrand, from, to);
    case 21:
      return panel<21>(integrand, from, to);
    case 41:
      return panel<41>(integrand, from, to);
    case 51:
      return panel<51>(integrand, from, to);
    case 61:
      return panel<61>(integrand, from, to);
    default:
      return panel<31>(integrand, from, to);
  }
}

void check(const Quadrature& rule) {
  constexpr std::array known = {15, 21, 31, 41, 51, 61};
  if (std::find(known.begin(), known.end(), rule.points) == known.end())
    throw std::invalid_argument("a panel has 15, 21, 31, 41, 51 or 61 points");
  if (rule.halvings < 0 || !(rule.error_limit > 0.0))
    throw std::invalid_argument("halvings must be >= 0, the error limit > 0");
}

/// `whole`, the panel between `from` and `to`, halved until its error is at most `tolerance`.
Integral refine(const auto& integrand, double from, double to, const Integral& whole,
                double tolerance, int points, int levels) {
  if (whole.error <= tolerance || levels == 0) return whole;
  const double middle = 0.5 * (from + to);
  const auto half = [&](double a, double b) {
    return refine(integrand, a, b, panel(integrand, a, b, points), tolerance, points, levels - 1);
  };
  Integral sum = half(from, middle);
  sum += half(middle, to);
  return sum;
}

/// The integral over the panels between neighbouring `borders`, which rise.
///
/// No panel is halved to get below the errors of the integrand's values.
///
/// @param rounding  their relative error
/// @param noise     what their absolute error may add to the integral
Integral integrate(const auto& integrand, const std::vector<double>& borders, double rounding,
                   double noise, const Quadrature& rule) {
  std::vector<Integral> coarse;
  double magnitude = 0.0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    coarse.push_back(panel(integrand, borders[i], borders[i + 1], rule.points));
    magnitude += coarse.back().magnitude;
  }
  const double tolerance = (1e-14 + rounding) * magnitude + noise;
  Integral sum;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    sum += refine(integrand, borders[i], borders[i + 1], coarse[i], tolerance, rule.points,
                  rule.halvings);
  sum.error += rounding * magnitude;
  return sum;
}

/// One response to each component of the load, a `PadKernel` or a `HatKernel`.
template <class Kernel>
struct Responses {
  /// @param width  what the kernel's constructor takes besides: a hat's half width, or nothing
  Responses(const Channel& channel, const Material& material, auto... width)
      : normal(channel.quantity, Traction::normal, material, channel.depth, width...),
        tangential(channel.quantity, Traction::tangential_y, material, channel.depth, width...) {}
  Kernel normal;
  Kernel tangential;
};

/// A taxel and what is known of its kernels.
struct Point {
  double y;
  double depth;
  double base_error;

  /// Relative error that rounded places between s.from and s.to cause: a kernel changes over the
  /// distance of the nearest of them.
  [[nodiscard]] double rounding(Interval s) const noexcept {
    const double nearest = std::hypot(depth, std::max({0.0, s.from - y, y - s.to}));
    return std::numeric_limits<double>::epsilon() * std::max(std::abs(s.from), std::abs(s.to)) /
           nearest;
  }

  /// The integral over t.from ... t.to of `integrand`, whose variable `image` makes of a place
  /// between s.from and s.to. The kernels' only singularities are at y +- i depth, so that panels
  /// whose size grows with the distance from y converge fast.
  [[nodiscard]] Integral load(Interval s, Interval t, double force, const Quadrature& rule,
                              const auto& image, const auto& integrand) const {
    return integrate(integrand, borders(s, t, image), rounding(s), force * base_error, rule);
  }

 private:
  /// y and y +- depth 4^j between s.from and s.to, as `image` maps them, and both ends.
  [[nodiscard]] std::vector<double> borders(Interval s, Interval t, const auto& image) const {
    std::vector<double> result{t.from};
    const auto add = [&](double point) {
      if (point > s.from && point < s.to) result.push_back(image(point));
    };
    add(y);
    const double farthest = std::max(std::abs(y - s.from), std::abs(y - s.to));
    for (double distance = depth; distance < farthest; distance *= 4.0) {
      add(y - distance);
      add(y + distance);
    }
    result.push_back(t.to);
    std::sort(result.begin(), result.end());
    return result;
  }
};

/// The force without its signs, of both components [N/m].
double magnitude(const RigidContact& contact) noexcept {
  return std::abs(contact.force) * (1.0 + std::abs(contact.friction));
}

double magnitude(const SampledTractions& contact) noexcept {
  double sum = 0.0;
  for (const double value : contact.normal) sum += std::abs(value);
  for (const double value : contact.tangential) sum += std::abs(value);
  return contact.pitch * sum;
}

/// Indenters: s = center + place(t) and f_v ds = weight(t) dt.
Integral reading(const Point& taxel, const Responses<PadKernel>& kernels,
                 const RigidContact& contact, const Quadrature& rule) {
  const double p = contact.force;
  const double a = contact.half_width;
  const double b = a + contact.edge;
  const auto over = [&](Interval s, Interval t, const auto& place, const auto& image,
                        const auto& weight) {
    const auto integrand = [&](double u) {
      const double distance = taxel.y - (contact.center + place(u));
      double sum = kernels.normal(distance);
      if (contact.friction != 0.0) sum += contact.friction * kernels.tangential(distance);
      return weight(u) * sum;
    };
    const auto centred = [&](double y) { return image(y - contact.center); };
    return taxel.load(s, t, magnitude(contact), rule, centred, integrand);
  };
  const Interval whole = support(contact);

  switch (contact.shape) {
    case Shape::cylinder:
      return over(
          whole, {-0.5 * pi, 0.5 * pi}, [=](double t) { return a * std::sin(t); },
          [=](double s) { return std::asin(std::clamp(s / a, -1.0, 1.0)); },
          [=](double t) { return 2.0 / pi * p * std::cos(t) * std::cos(t); });
    case Shape::punch: {
      const double end = std::asin(a / b);
      return over(
          whole, {-end, end}, [=](double t) { return b * std::sin(t); },
          [=](double s) { return std::clamp(std::asin(std::clamp(s / b, -1.0, 1.0)), -end, end); },
          [=](double) { return p / pi; });
    }
    case Shape::wedge: {
      // On each side of the apex s = a / cosh v, where the traction is proportional to v.
      constexpr double far = 60.0;  // beyond it less than 1e-24 of the force
      const auto image = [=](double s) {
        return std::min(std::acosh(std::max(std::abs(a / s), 1.0)), far);
      };
      const auto weight = [=](double v) { return p / pi * v * std::tanh(v) / std::cosh(v); };
      Integral sum = over(
          {whole.from, contact.center}, {0.0, far}, [=](double v) { return -a / std::cosh(v); },
          image, weight);
      sum += over(
          {contact.center, whole.to}, {0.0, far}, [=](double v) { return a / std::cosh(v); }, image,
          weight);
      return sum;
    }
  }
  return {};
}

/// A cylinder on a half plane has its reading in closed form, to some ulp of the parts of which it
/// is the difference: 2 P over the half width, or over the depth where that is more.
Integral reading(const Point& taxel, const PatchKernel& kernel, double unit,
                 const RigidContact& contact) {
  std::array<double, 1> value{};
  kernel.add({.form = LoadPatch::Form::hertz,
              .center = contact.center,
              .half_width = contact.half_width,
              .normal = contact.force,
              .tangential = contact.friction * contact.force},
             taxel.y, 1.0, value);
  const double parts = unit * 2.0 * magnitude(contact) / std::max(contact.half_width, taxel.depth);
  const double rounding =
      8.0 * std::numeric_limits<double>::epsilon() + taxel.rounding(support(contact));
  return {value[0], rounding * parts, parts};
}

/// Shallower taxels have readings that are small differences of those parts.
bool has_closed_form(const RigidContact& contact, const Channel& channel,
                     const Material& material) noexcept {
  return contact.shape == Shape::cylinder && !material.layer &&
         channel.depth >= 0.01 * contact.half_width;
}

/// Piecewise linear tractions are a sum of hats, each of which has its reading in closed form.
Integral reading(const Point& taxel, const Responses<HatKernel>& hats,
                 const SampledTractions& contact) {
  Integral sum;
  const auto add = [&](const HatKernel& hat, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == 0.0) continue;
      const double distance = taxel.y - (contact.first + static_cast<double>(i) * contact.pitch);
      const double value = values[i] * hat(distance);
      sum += {value, std::abs(values[i]) * hat.error_bound(distance), std::abs(value)};
    }
  };
  add(hats.normal, contact.normal);
  add(hats.tangential, contact.tangential);
  sum.error += taxel.rounding(support(contact)) * sum.magnitude;
  return sum;
}

}  // namespace

std::vector<double> exact_readings(const Channel& channel, std::span<const double> places,
                                   const Material& material, std::span<const Contact> contacts,
                                   const Quadrature& rule, const Aperture& aperture) {
  check(rule);
  check(material);
  check_depth(material, channel.depth);
  for (const Contact& contact : contacts) check(contact);

  const double base = base_error(channel.quantity, material);
  std::optional<Responses<PadKernel>> kernels;  // of line loads, made when first needed
  std::vector<double> readings(places.size());
  const auto add = [&](const auto& contact, const auto& reading) {
    Integral worst;  // the largest of each, over the taxels
    for (std::size_t j = 0; j < places.size(); ++j) {
      Integral g;
      for (const auto& [offset, weight] : aperture.nodes()) {
        const Integral point = reading(Point{places[j] + offset, channel.depth, base});
        g += {weight * point.value, weight * point.error, weight * point.magnitude};
      }
      worst.value = std::max(worst.value, std::abs(g.value));
      worst.error = std::max(worst.error, g.error);
      worst.magnitude = std::max(worst.magnitude, g.magnitude);
      readings[j] += g.value;
    }
    const double accepted =
        std::max(rule.error_limit * worst.value,
                 cancellation * worst.magnitude + 4.0 * base * magnitude(contact));
    if (!(worst.error <= accepted) && std::isfinite(rule.error_limit))
      throw std::runtime_error(channel.name + " at depth " + shortest(channel.depth) +
                               ": the integral is known only to " + shortest(worst.error) +
                               ", its peak is " + shortest(worst.value) +
                               "; the model sampled has no integral");
  };
  for (const Contact& contact : contacts) {
    const auto* rigid = std::get_if<RigidContact>(&contact);
    if (rigid != nullptr && has_closed_form(*rigid, channel, material)) {
      const PatchKernel kernel(std::array{channel.quantity}, material, channel.depth);
      const double unit = is_strain(channel.quantity) ? 1.5 / material.youngs_modulus : 1.0;
      add(*rigid, [&](const Point& taxel) { return reading(taxel, kernel, unit, *rigid); });
    } else if (rigid != nullptr) {
      if (!kernels) kernels.emplace(channel, material);
      add(*rigid, [&](const Point& taxel) { return reading(taxel, *kernels, *rigid, rule); });
    } else {
      const auto& sampled = std::get<SampledTractions>(contact);
      const Responses<HatKernel> hats(channel, material, sampled.pitch);
      add(sampled, [&](const Point& taxel) { return reading(taxel, hats, sampled); });
    }
  }
  return readings;
}

std::vector<double> exact_readings(const SensorArray& array, const Material& material,
                                   std::span<const Contact> contacts, const Quadrature& rule) {
  check(array);
  // Taxels of one quantity at one depth, equally wide, share their kernels; regular arrays have
  // them side by side.
  const std::vector<Site> all = sites(array);
  // By channel, depth, width.
  std::map<std::tuple<std::size_t, double, double>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < all.size(); ++i)
    alike[{all[i].channel, all[i].depth, all[i].width}].push_back(i);

  const std::vector<Channel> named = channels(array);
  std::vector<double> readings(all.size());
  for (const auto& [which, indices] : alike) {
    const auto& [channel, depth, width] = which;
    std::vector<double> places;
    for (const std::size_t i : indices) places.push_back(all[i].y);
    const std::vector<double> block =
        exact_readings({named[channel].quantity, depth, named[channel].name}, places, material,
                       contacts, rule, Aperture(width, depth));
    for (std::size_t k = 0; k < indices.size(); ++k) readings[indices[k]] = block[k];
  }
  return readings;
}

}  // namespace tactile_net
