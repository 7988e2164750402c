#include "tactile_net/sensing/exact.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "numeric/require.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

namespace {

using std::numbers::pi;

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
/// @param rounding  relative error of the integrand's values: no panel is halved to get below it
Integral integrate(const auto& integrand, const std::vector<double>& borders, double rounding,
                   const Quadrature& rule) {
  std::vector<Integral> coarse;
  double magnitude = 0.0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    coarse.push_back(panel(integrand, borders[i], borders[i + 1], rule.points));
    magnitude += coarse.back().magnitude;
  }
  const double tolerance = (1e-14 + rounding) * magnitude;
  Integral sum;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    sum += refine(integrand, borders[i], borders[i + 1], coarse[i], tolerance, rule.points,
                  rule.halvings);
  sum.error += rounding * magnitude;
  return sum;
}

/// What a taxel sees: the kernels of both loads, as seen from y. Their only singularities are at
/// y +- i depth, so that panels whose size grows with the distance from y converge fast.
struct View {
  const PadKernel& normal;
  const PadKernel& tangential;
  double depth;
  double y;
  const Quadrature& rule;

  [[nodiscard]] double kernel(Traction component, double s) const noexcept {
    return component == Traction::normal ? normal(y - s) : tangential(y - s);
  }

  /// The load on s.from ... s.to, which `image` maps to t.from ... t.to, where `integrand` lives.
  [[nodiscard]] Integral load(Interval s, Interval t, const auto& image,
                              const auto& integrand) const {
    // Places are rounded, and the kernel changes over the distance of the nearest of them.
    const double nearest = std::hypot(depth, std::max({0.0, s.from - y, y - s.to}));
    const double rounding = std::numeric_limits<double>::epsilon() *
                            std::max(std::abs(s.from), std::abs(s.to)) / nearest;
    return integrate(integrand, borders(s, t, image), rounding, rule);
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

/// Indenters: s = center + place(t) and f_v ds = weight(t) dt.
Integral reading(const View& view, const RigidContact& contact) {
  const double p = contact.force;
  const double a = contact.half_width;
  const double b = a + contact.edge;
  const auto over = [&](Interval s, Interval t, const auto& place, const auto& image,
                        const auto& weight) {
    const auto integrand = [&](double u) {
      const double from = contact.center + place(u);
      double sum = view.kernel(Traction::normal, from);
      if (contact.friction != 0.0)
        sum += contact.friction * view.kernel(Traction::tangential, from);
      return weight(u) * sum;
    };
    const auto centred = [&](double y) { return image(y - contact.center); };
    return view.load(s, t, centred, integrand);
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

/// Segment by segment of the piecewise linear tractions, except where they are zero.
Integral reading(const View& view, const SampledTractions& contact) {
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    return i < values.size() ? values[i] : 0.0;
  };
  Integral sum;
  for (std::size_t i = 0; i <= contact.normal.size(); ++i) {
    // From value i - 1 to value i; i - 1 wraps to a place beyond the end, which is zero as well.
    const Interval normal{at(contact.normal, i - 1), at(contact.normal, i)};
    const Interval tangential{at(contact.tangential, i - 1), at(contact.tangential, i)};
    const bool has_normal = normal.from != 0.0 || normal.to != 0.0;
    const bool has_tangential = tangential.from != 0.0 || tangential.to != 0.0;
    if (!has_normal && !has_tangential) continue;

    const double start = contact.first + (static_cast<double>(i) - 1.0) * contact.pitch;
    const auto integrand = [&](double w) {
      const double s = start + w * contact.pitch;
      double value = 0.0;
      if (has_normal)
        value += std::lerp(normal.from, normal.to, w) * view.kernel(Traction::normal, s);
      if (has_tangential)
        value +=
            std::lerp(tangential.from, tangential.to, w) * view.kernel(Traction::tangential, s);
      return contact.pitch * value;
    };
    const auto image = [&](double s) { return std::clamp((s - start) / contact.pitch, 0.0, 1.0); };
    sum += view.load({start, start + contact.pitch}, {0.0, 1.0}, image, integrand);
  }
  return sum;
}

}  // namespace

std::vector<double> exact_readings(const SensorArray& array, const Material& material,
                                   std::span<const Contact> contacts, const Quadrature& rule) {
  check(rule);
  check(array);
  check(material);
  for (const Contact& contact : contacts) check(contact);

  std::vector<double> readings;
  for (const Channel& channel : channels(array)) {
    const PadKernel normal(channel.quantity, Traction::normal, material, channel.depth);
    const PadKernel tangential(channel.quantity, Traction::tangential, material, channel.depth);
    std::vector<double> sum(array.count);
    for (const Contact& contact : contacts) {
      double peak = 0.0;
      double error = 0.0;
      for (std::size_t j = 0; j < array.count; ++j) {
        const View view{normal, tangential, channel.depth, position(array, j), rule};
        const Integral g = std::visit([&](const auto& c) { return reading(view, c); }, contact);
        peak = std::max(peak, std::abs(g.value));
        error = std::max(error, g.error);
        sum[j] += g.value;
      }
      if (!(error <= rule.error_limit * peak) && std::isfinite(rule.error_limit))
        throw std::runtime_error(channel.name + " at depth " + shortest(channel.depth) +
                                 ": the integral is known only to " + shortest(error) +
                                 ", its peak is " + shortest(peak) +
                                 "; the model sampled has no integral");
    }
    readings.insert(readings.end(), sum.begin(), sum.end());
  }
  return readings;
}

}  // namespace tactile_net
