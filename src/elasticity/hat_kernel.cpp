#include "tactile_net/elasticity/hat_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "elasticity/cauchy_weights.hpp"
#include "elasticity/layer_correction.hpp"
#include "numeric/gauss_rule.hpp"
#include "numeric/require.hpp"
#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

constexpr double widest_part = 4.0;  // half width of a hat with interpolants of its own, in layers
constexpr double exact_beyond =
    3.0;  // half widths from the middle beyond which a quadrature is exact
constexpr double rounding = 4e-15;  // of the closed form and of the quadrature, relative

/// C and w C' of the hat, close by.
struct Cauchy {
  Complex potential, slope;
};

/// At u + i depth, depth > 0. A hat is a second difference of |s|, C therefore of z log z.
Cauchy cauchy(double u, double depth, double half_width) {
  const double height = depth / half_width;
  const Complex z{u / half_width, height};
  const Complex ahead{(u + half_width) / half_width, height};
  const Complex behind{(u - half_width) / half_width, height};
  const Complex log_z = std::log(z);
  const Complex log_ahead = std::log(ahead);
  const Complex log_behind = std::log(behind);
  return {ahead * log_ahead - 2.0 * z * log_z + behind * log_behind,
          log_ahead - 2.0 * log_z + log_behind};
}

/// The integral of hat(s) line(u - s) where the line load's reading has its poles `exact_beyond`
/// half widths from the middle or farther: 10 points err by less than 1e-15.
double integral(double u, double half_width, const auto& line) {
  const auto at = [&](double t) {
    const double s = t * half_width;
    return (1.0 - t) * (line(u - s) + line(u + s));
  };
  const GaussRule rule = gauss_rule<10>();
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
    sum += (at(0.5 + 0.5 * rule.abscissa[i]) + at(0.5 - 0.5 * rule.abscissa[i])) * rule.weights[i];
  return half_width * 0.5 * sum;
}

/// Sum of the weights 1 - |i| / parts of the narrower hats up to i = `last`.
double weight_up_to(double last, double parts) noexcept {
  if (last >= 0.0) return parts - weight_up_to(-last - 1.0, parts);
  const double terms = parts + last;
  return 0.5 * terms * (terms + 1.0) / parts;
}

}  // namespace

HatKernel::HatKernel(Quantity quantity, Traction component, const Material& material, double depth,
                     double half_width)
    : quantity_(quantity),
      component_(component),
      material_(material),
      depth_(depth),
      part_width_(half_width) {
  check_line(quantity);
  check_line(component);
  check(material);
  check_depth(material, depth);
  require_positive("half_width", half_width);
  const CauchyWeights weights = cauchy_weights(quantity, component, material);
  potential_ = weights.potential;
  slope_ = weights.slope;
  if (!material.layer) return;
  const double thickness = material.layer->thickness;
  parts_ = std::ceil(half_width / (widest_part * thickness));
  part_width_ = half_width / parts_;
  correction_ =
      std::make_shared<LayerCorrection>(quantity, component, material, depth, part_width_);
  layer_error_ = base_error(quantity, material) * std::min(half_width, thickness);
}

double HatKernel::half_plane(double u) const noexcept {
  if (std::hypot(u, depth_) >= exact_beyond * part_width_)
    return integral(u, part_width_, [this](double y) {
      return half_plane_kernel(quantity_, component_, material_, depth_, y);
    });
  const auto [potential, slope] = cauchy(u, depth_, part_width_);
  const CauchyWeights weights{potential_, slope_, is_odd(quantity_, component_)};
  return weights.reading(potential, slope, depth_ / part_width_);
}

double HatKernel::part(double u) const noexcept {
  return correction_ ? correction_->corrected(half_plane(u), u) : half_plane(u);
}

double HatKernel::operator()(double u) const noexcept {
  const double distance = std::abs(u);
  const double sign = is_odd(quantity_, component_) && u < 0.0 ? -1.0 : 1.0;
  if (parts_ == 1.0) return sign * part(distance);

  // Parts out of reach contribute the limit, whose sign is that of the distance.
  const double reach = correction_->reach();
  const double first = std::max(std::ceil((distance - reach) / part_width_), 1.0 - parts_);
  const double last = std::min(std::floor((distance + reach) / part_width_), parts_ - 1.0);
  const double behind = weight_up_to(std::min(first, parts_) - 1.0, parts_);
  const double ahead = parts_ - weight_up_to(last, parts_);
  double sum = correction_->limit() * (behind - ahead);
  for (double i = first; i <= last; ++i)
    sum += (1.0 - std::abs(i) / parts_) * part(distance - i * part_width_);
  return sign * sum;
}

double HatKernel::error_bound(double u) const noexcept {
  const double half_width = parts_ * part_width_;
  if (std::hypot(u, depth_) < exact_beyond * half_width)
    return rounding * (std::abs(potential_) + std::abs(slope_)) + layer_error_;
  // Hooke's terms may cancel, their rounding does not.
  const auto stress = [&](Quantity quantity, double y) {
    return std::abs(half_plane_kernel(quantity, component_, material_, depth_, y));
  };
  const auto terms = [&](double y) {
    if (!is_strain(quantity_)) return stress(quantity_, y);
    return stress(Quantity::stress_x, y) + stress(Quantity::stress_y, y);
  };
  const double scale = is_strain(quantity_) ? 1.5 / material_.youngs_modulus : 1.0;
  return rounding * scale * integral(u, half_width, terms) + layer_error_;
}

}  // namespace tactile_net
