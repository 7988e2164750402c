#include "tactile_net/elasticity/patch_kernel.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "elasticity/cauchy_weights.hpp"
#include "elasticity/layer_correction.hpp"
#include "numeric/gauss_rule.hpp"
#include "tactile_net/elasticity/half_plane.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

constexpr double far_half_widths = 3.0;  // half widths beyond which one panel of the rule is exact
constexpr double correction = 1e-14;     // share of what a base adds that may be left

/// C and C' of both tractions.
struct Transforms {
  Complex normal, normal_slope, tangential, tangential_slope;
};

/// 1 / z, where std::complex looks for infinities.
Complex inverse(const Complex& z) noexcept {
  const double scale = 1.0 / (z.real() * z.real() + z.imag() * z.imag());
  return {z.real() * scale, -z.imag() * scale};
}

Complex product(const Complex& a, const Complex& b) noexcept {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// The root of (z - a) (z + a) that goes as z: its imaginary part is positive where z's is.
Complex root(const Complex& z, double a) noexcept {
  const Complex square = product(z - a, z + a);
  const double size = std::hypot(square.real(), square.imag());
  if (square.real() > 0.0) {
    const double real = std::copysign(std::sqrt(0.5 * (size + square.real())), z.real());
    return {real, 0.5 * square.imag() / real};
  }
  const double imaginary = std::sqrt(0.5 * (size - square.real()));
  return {0.5 * square.imag() / imaginary, imaginary};
}

Transforms hertz(const LoadPatch& patch, const Complex& z) noexcept {
  const Complex w = root(z, patch.half_width);
  const Complex unit = 2.0 * inverse(z + w);
  const Complex slope = -product(unit, inverse(w));
  return {patch.normal * unit, patch.normal * slope, patch.tangential * unit,
          patch.tangential * slope};
}

Transforms linear_nearby(const LoadPatch& patch, const Complex& z) noexcept {
  const double a = patch.half_width;
  const double mean = 0.5 * patch.normal / a;
  const double rise = 1.5 * patch.moment / (a * a * a);
  const double drag = 0.5 * patch.tangential / a;
  const Complex log = std::log(product(z + a, inverse(z - a)));
  const Complex slope = inverse(z + a) - inverse(z - a);
  const Complex there = mean + rise * z;
  return {product(there, log) - 2.0 * a * rise, rise * log + product(there, slope), drag * log,
          drag * slope};
}

/// The patch as line loads: `use(t, normal, tangential)` at the distance t from its centre, their
/// sums the patch's forces.
///
/// @param pole  distance from the surface to where the reading has its nearest pole [m]
void for_each_line_load(const LoadPatch& patch, double pole, const auto& use) {
  const GaussRule rule = gauss_rule<10>();
  const double a = patch.half_width;
  if (patch.form == LoadPatch::Form::hertz) {  // Gauss and Chebyshev, of the second kind
    const double count = std::ceil(-0.5 * std::log(correction) / std::asinh(pole / a));
    const double share = 2.0 / (count + 1.0);
    for (double i = 1.0; i <= count; ++i) {
      const double angle = std::numbers::pi * i / (count + 1.0);
      const double weight = share * std::sin(angle) * std::sin(angle);
      use(a * std::cos(angle), weight * patch.normal, weight * patch.tangential);
    }
    return;
  }
  const double panels = std::ceil(2.0 * a / pole);
  const double half = a / panels;
  const double rise = 1.5 * patch.moment / (a * a * a);
  for (double panel = 0.0; panel < panels; ++panel) {
    const double middle = (2.0 * panel + 1.0) * half - a;
    for (std::size_t i = 0; i < rule.abscissa.size(); ++i) {
      const double share = half * rule.weights[i];
      const auto at = [&](double t) {
        use(t, share * (0.5 * patch.normal / a + rise * t), share * 0.5 * patch.tangential / a);
      };
      at(middle - half * rule.abscissa[i]);
      at(middle + half * rule.abscissa[i]);
    }
  }
}

Transforms linear_far_away(const LoadPatch& patch, const Complex& z) noexcept {
  Transforms sum;
  const double pole = std::hypot(z.real(), z.imag());
  for_each_line_load(patch, pole, [&](double t, double normal, double tangential) {
    const Complex unit = inverse(z - t);
    const Complex slope = -product(unit, unit);
    sum.normal += normal * unit;
    sum.normal_slope += normal * slope;
    sum.tangential += tangential * unit;
    sum.tangential_slope += tangential * slope;
  });
  return sum;
}

Transforms transforms(const LoadPatch& patch, const Complex& z) noexcept {
  if (patch.form == LoadPatch::Form::hertz) return hertz(patch, z);
  return std::hypot(z.real(), z.imag()) < far_half_widths * patch.half_width
             ? linear_nearby(patch, z)
             : linear_far_away(patch, z);
}

}  // namespace

/// One quantity: what a half plane makes of the transforms, and what a layer's base adds.
struct PatchKernel::Reading {
  Quantity quantity;
  CauchyWeights normal, tangential;
  std::shared_ptr<const LayerCorrection> normal_base, tangential_base;  // absent: half plane

  /// What the base adds to a unit line load's reading at the distance u.
  [[nodiscard]] double base(Traction component, const Material& material, double depth,
                            double u) const noexcept {
    const LayerCorrection& added = component == Traction::normal ? *normal_base : *tangential_base;
    const double alone = std::abs(u) < added.reach()
                             ? 0.0
                             : half_plane_kernel(quantity, component, material, depth, u);
    return added.corrected(alone, u) - alone;
  }
};

PatchKernel::PatchKernel(std::span<const Quantity> reads, const Material& material, double depth)
    : material_(material), depth_(depth) {
  check(material);
  check_depth(material, depth);
  for (const Quantity quantity : reads) {
    check_line(quantity);
    const auto base = [&](Traction component) {
      return material.layer
                 ? std::make_shared<LayerCorrection>(quantity, component, material, depth)
                 : nullptr;
    };
    reads_.push_back({.quantity = quantity,
                      .normal = cauchy_weights(quantity, Traction::normal, material),
                      .tangential = cauchy_weights(quantity, Traction::tangential_y, material),
                      .normal_base = base(Traction::normal),
                      .tangential_base = base(Traction::tangential_y)});
  }
}

PatchKernel::~PatchKernel() = default;
PatchKernel::PatchKernel(PatchKernel&&) noexcept = default;

void PatchKernel::add(const LoadPatch& patch, double y, double weight,
                      std::span<double> readings) const noexcept {
  const double u = y - patch.center;
  const Transforms at = transforms(patch, {u, depth_});
  for (std::size_t i = 0; i < reads_.size(); ++i)
    readings[i] +=
        weight * (reads_[i].normal.reading(at.normal, at.normal_slope, depth_) +
                  reads_[i].tangential.reading(at.tangential, at.tangential_slope, depth_));
  if (!material_.layer) return;
  const double pole = 2.0 * material_.layer->thickness - depth_;  // of what the base adds
  for_each_line_load(patch, pole, [&](double t, double normal, double tangential) {
    for (std::size_t i = 0; i < reads_.size(); ++i) {
      const auto base = [&](Traction component) {
        return reads_[i].base(component, material_, depth_, u - t);
      };
      readings[i] += weight * normal * base(Traction::normal);
      if (tangential != 0.0) readings[i] += weight * tangential * base(Traction::tangential_y);
    }
  });
}

}  // namespace tactile_net
