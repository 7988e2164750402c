#include "elasticity/layer_correction.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "elasticity/hooke.hpp"
#include "elasticity/layer.hpp"
#include "numeric/gauss_rule.hpp"
#include "tactile_net/elasticity/half_plane.hpp"

namespace tactile_net {
namespace {

using std::numbers::pi;

constexpr std::size_t points = 16;      // of one panel
constexpr double panel_share = 0.5;     // of h
constexpr double reach_of_line = 48.0;  // in units of h
constexpr double largest_decay = 52.0;  // |k| (2 h - depth) up to which the integral runs

/// Chebyshev points of the first kind in (-1, 1) and their barycentric weights.
struct Nodes {
  Nodes() {
    for (std::size_t i = 0; i < points; ++i) {
      const double angle = pi * (2.0 * static_cast<double>(i) + 1.0) / (2.0 * points);
      at[i] = std::cos(angle);
      weight[i] = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle);
    }
  }
  std::array<double, points> at{}, weight{};
};

const Nodes& nodes() {
  static const Nodes table;
  return table;
}

double interpolate(const double* values, double at) noexcept {
  const Nodes& table = nodes();
  double above = 0.0;
  double below = 0.0;
  for (std::size_t i = 0; i < points; ++i) {
    const double distance = at - table.at[i];
    if (distance == 0.0) return values[i];
    const double weight = table.weight[i] / distance;
    above += weight * values[i];
    below += weight;
  }
  return above / below;
}

/// What holds a tangential load on a frictionless base is stress_y, half of it on each side.
double limit_of(Quantity quantity, Traction component, const Material& material) noexcept {
  if (component != Traction::tangential_y || material.layer->base != Base::frictionless) return 0.0;
  const double half = 0.5 / material.layer->thickness;
  return read(quantity, Stress<double>{.x = 0.0, .y = half, .shear = 0.0}, material);
}

double load_transform(double half_width, double wavenumber) noexcept {
  const double angle = 0.5 * wavenumber * half_width;
  if (angle == 0.0) return half_width > 0.0 ? half_width : 1.0;
  const double sinc = std::sin(angle) / angle;
  return half_width * sinc * sinc;
}

}  // namespace

LayerCorrection::LayerCorrection(Quantity quantity, Traction component, const Material& material,
                                 double depth, double half_width)
    : is_odd_(is_odd(quantity, component)),
      panel_width_(panel_share * material.layer->thickness),
      panels_(static_cast<std::size_t>(
          std::ceil(reach_of_line / panel_share + half_width / panel_width_))),
      limit_(limit_of(quantity, component, material) * load_transform(half_width, 0.0)),
      values_(panels_ * points) {
  // 20 points resolve 20 radians of exp(i k y) at the largest y, and every pole's distance; a hat's
  // transform turns by k w beside it.
  const GaussRule rule = gauss_rule<20>();
  const double width = 20.0 / (reach() + half_width);
  const double end = largest_decay / (2.0 * material.layer->thickness - depth);
  const auto count = static_cast<std::size_t>(std::ceil(end / width));
  const auto add = [&](double k, double weight) {
    const std::complex<double> difference =
        layer_transform(quantity, component, material, depth, k) -
        half_plane_transform(quantity, component, material, depth, k);
    const double amplitude = (is_odd_ ? -difference.imag() : difference.real()) *
                             load_transform(half_width, k) * weight / pi;
    const std::complex<double> step = std::polar(1.0, k * panel_width_);
    for (std::size_t i = 0; i < points; ++i) {
      const double start = 0.5 * panel_width_ * (1.0 + nodes().at[i]);
      std::complex<double> wave = amplitude * std::polar(1.0, k * start);
      for (std::size_t p = 0; p < panels_; ++p) {
        values_[p * points + i] += is_odd_ ? wave.imag() : wave.real();
        wave = {wave.real() * step.real() - wave.imag() * step.imag(),
                wave.real() * step.imag() + wave.imag() * step.real()};
      }
    }
  };
  for (std::size_t panel = 0; panel < count; ++panel) {
    const double middle = (static_cast<double>(panel) + 0.5) * width;
    for (std::size_t i = 0; i < rule.abscissa.size(); ++i) {
      const double offset = 0.5 * width * rule.abscissa[i];
      const double weight = 0.5 * width * rule.weights[i];
      add(middle + offset, weight);
      add(middle - offset, weight);
    }
  }
}

double LayerCorrection::corrected(double half_plane, double y) const noexcept {
  if (std::isnan(y)) return y;
  const double sign = is_odd_ && y < 0.0 ? -1.0 : 1.0;
  const double at = std::abs(y) / panel_width_;
  if (at >= static_cast<double>(panels_)) return sign * limit_;
  const auto panel = static_cast<std::size_t>(at);
  const double inside = 2.0 * (at - static_cast<double>(panel)) - 1.0;
  return half_plane + sign * interpolate(values_.data() + panel * points, inside);
}

}  // namespace tactile_net
