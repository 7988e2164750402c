#include "tactile_net/elasticity/hat_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "elasticity/hooke.hpp"
#include "elasticity/layer_correction.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr double widest_part = 4.0;  // half width of a hat with interpolants of its own, in layers

/// log(1 + z), to some ulp of its magnitude for small z too; |z| <= 1/2.
Complex log_1p(Complex z) {
  const double x = z.real();
  const double y = z.imag();
  return {0.5 * std::log1p(2.0 * x + (x * x + y * y)), std::atan2(y, 1.0 + x)};
}

/// C and w C' of the hat.
struct Cauchy {
  Complex potential, slope;
};

/// At u + i depth, depth > 0.
Cauchy cauchy(double u, double depth, double half_width) {
  const double r = std::hypot(u, depth);
  if (r >= 2.0 * half_width) {
    const Complex q = half_width / r * Complex{u / r, -depth / r};
    const Complex slope = log_1p(-q * q);
    return {slope / q + log_1p(q) - log_1p(-q), slope};
  }
  // The hat is a second difference of |s|, C therefore of z log z; close by it loses nothing.
  const Complex z{u / half_width, depth / half_width};
  const Complex ahead{(u + half_width) / half_width, z.imag()};
  const Complex behind{(u - half_width) / half_width, z.imag()};
  const Complex log_z = std::log(z);
  const Complex log_ahead = std::log(ahead);
  const Complex log_behind = std::log(behind);
  return {ahead * log_ahead - 2.0 * z * log_z + behind * log_behind,
          log_ahead - 2.0 * log_z + log_behind};
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
    : depth_(depth), is_odd_(is_odd(quantity, component)), part_width_(half_width) {
  check(material);
  check_depth(material, depth);
  require_positive("half_width", half_width);

  // Even readings are made of -Im C and depth Re C', odd ones of Re C and depth Im C', so that
  // Hooke's law cancels in the weights, before any value is rounded.
  const bool normal = component == Traction::normal;
  potential_ = read(quantity,
                    normal ? Stress<double>{.x = 1.0, .y = 1.0, .shear = 0.0}
                           : Stress<double>{.x = 0.0, .y = 2.0, .shear = 1.0},
                    material) /
               pi;
  slope_ = read(quantity,
                normal ? Stress<double>{.x = 1.0, .y = -1.0, .shear = 1.0}
                       : Stress<double>{.x = 1.0, .y = -1.0, .shear = -1.0},
                material) /
           pi;
  if (!material.layer) return;
  const double thickness = material.layer->thickness;
  parts_ = std::ceil(half_width / (widest_part * thickness));
  part_width_ = half_width / parts_;
  correction_ =
      std::make_shared<LayerCorrection>(quantity, component, material, depth, part_width_);
  layer_error_ =
      1e-13 * (std::abs(potential_) + std::abs(slope_)) * std::min(half_width / thickness, 1.0);
}

double HatKernel::part(double u) const noexcept {
  const auto [potential, slope] = cauchy(u, depth_, part_width_);
  const double share = slope_ * (depth_ / part_width_);
  const double half_plane = is_odd_ ? potential_ * potential.real() + share * slope.imag()
                                    : share * slope.real() - potential_ * potential.imag();
  return correction_ ? correction_->corrected(half_plane, u) : half_plane;
}

double HatKernel::operator()(double u) const noexcept {
  const double distance = std::abs(u);
  const double sign = is_odd_ && u < 0.0 ? -1.0 : 1.0;
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
  const double size = std::min(parts_ * part_width_ / std::hypot(u, depth_), 4.0);
  return 4e-15 * size * (std::abs(potential_) + std::abs(slope_)) + layer_error_;
}

}  // namespace tactile_net
