#include "tactile_net/elasticity/pad_kernel.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "elasticity/hooke.hpp"
#include "numeric/require.hpp"
#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/layer.hpp"

namespace tactile_net {
namespace {

using std::numbers::pi;

constexpr std::size_t points = 16;      // of one panel
constexpr std::size_t panels = 96;      // each h/2 wide
constexpr double panel_width = 0.5;     // in units of h
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

}  // namespace

std::complex<double> pad_transform(Quantity quantity, Traction component, const Material& material,
                                   double depth, double wavenumber) noexcept {
  return material.layer ? layer_transform(quantity, component, material, depth, wavenumber)
                        : half_plane_transform(quantity, component, material, depth, wavenumber);
}

PadKernel::PadKernel(Quantity quantity, Traction component, const Material& material, double depth)
    : quantity_(quantity),
      component_(component),
      material_(material),
      depth_(depth),
      is_odd_(tactile_net::is_odd(quantity, component)) {
  check(material);
  require_positive("depth", depth);
  if (!material.layer) return;
  const double h = material.layer->thickness;
  require(depth <= h, "depth", "be at most the layer's thickness", depth);

  // What holds a tangential load on a frictionless base is stress_y, half of it on each side.
  if (component == Traction::tangential && material.layer->base == Base::frictionless)
    limit_ = read(quantity, Stress<double>{.x = 0.0, .y = 0.5 / h, .shear = 0.0}, material);

  // 20 points resolve 20 radians of exp(i k y) at the largest y, and every pole's distance.
  using Rule = boost::math::quadrature::gauss<double, 20>;
  const double width = 20.0 / (panel_width * h * panels);
  const auto count = static_cast<std::size_t>(std::ceil(largest_decay / (2.0 * h - depth) / width));
  values_.assign(panels * points, 0.0);
  const auto add = [&](double k, double weight) {
    const std::complex<double> difference =
        layer_transform(quantity, component, material, depth, k) -
        half_plane_transform(quantity, component, material, depth, k);
    const double amplitude = (is_odd_ ? -difference.imag() : difference.real()) * weight / pi;
    const std::complex<double> step = std::polar(1.0, k * panel_width * h);
    for (std::size_t i = 0; i < points; ++i) {
      const double start = 0.5 * panel_width * h * (1.0 + nodes().at[i]);
      std::complex<double> wave = amplitude * std::polar(1.0, k * start);
      for (std::size_t p = 0; p < panels; ++p) {
        values_[p * points + i] += is_odd_ ? wave.imag() : wave.real();
        wave = {wave.real() * step.real() - wave.imag() * step.imag(),
                wave.real() * step.imag() + wave.imag() * step.real()};
      }
    }
  };
  for (std::size_t panel = 0; panel < count; ++panel) {
    const double middle = (static_cast<double>(panel) + 0.5) * width;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double offset = 0.5 * width * Rule::abscissa()[i];
      const double weight = 0.5 * width * Rule::weights()[i];
      add(middle + offset, weight);
      add(middle - offset, weight);
    }
  }
}

double PadKernel::operator()(double y) const noexcept {
  if (material_.layer && std::isfinite(y)) {
    const double sign = is_odd_ && y < 0.0 ? -1.0 : 1.0;
    const double at = std::abs(y) / (panel_width * material_.layer->thickness);
    if (!(at < static_cast<double>(panels))) return sign * limit_;
    const auto panel = static_cast<std::size_t>(at);
    const double inside = 2.0 * (at - static_cast<double>(panel)) - 1.0;
    return half_plane_kernel(quantity_, component_, material_, depth_, y) +
           sign * interpolate(values_.data() + panel * points, inside);
  }
  return half_plane_kernel(quantity_, component_, material_, depth_, y);
}

double relative_kernel_error(const Material& material) noexcept {
  return material.layer ? 1e-13 : 2e-15;
}

}  // namespace tactile_net
