#include "tactile_net/elasticity/patch_kernel.hpp"

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr double taxel_depth = 1.5;
const Material half_plane{.youngs_modulus = 0.2, .poisson_ratio = 0.45};
const Material bonded{
    .youngs_modulus = 0.2, .poisson_ratio = 0.45, .layer = Layer{.thickness = 2.5}};
const Material sliding{.youngs_modulus = 0.2,
                       .poisson_ratio = 0.3,
                       .layer = Layer{.thickness = 2.5, .base = Base::frictionless}};

double reading(const PatchKernel& kernel, const LoadPatch& patch, double y) {
  std::array<double, 1> sum{};
  kernel.add(patch, y, 1.0, sum);
  return sum[0];
}

/// The tractions as their names say, integrated over t = a sin v with the line loads' readings.
double integrated(const PadKernel& normal, const PadKernel& tangential, const LoadPatch& patch,
                  double y, double precision) {
  const double a = patch.half_width;
  const auto integrand = [&](double v) {
    const double t = a * std::sin(v);
    double pressure = 2.0 * patch.normal / (std::numbers::pi * a) * std::cos(v);
    double drag = 2.0 * patch.tangential / (std::numbers::pi * a) * std::cos(v);
    if (patch.form == LoadPatch::Form::linear) {
      pressure = 0.5 * patch.normal / a + 1.5 * patch.moment * t / (a * a * a);
      drag = 0.5 * patch.tangential / a;
    }
    const double u = y - patch.center - t;
    return a * std::cos(v) * (pressure * normal(u) + drag * tangential(u));
  };
  constexpr int panels = 16;
  double sum = 0.0;
  for (int i = 0; i < panels; ++i) {
    const double from = std::numbers::pi * (static_cast<double>(i) / panels - 0.5);
    sum += boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        integrand, from, from + std::numbers::pi / panels, 8, precision);
  }
  return sum;
}

}  // namespace

TEST_CASE("a patch's reading is the integral of its tractions' line loads", "[elasticity][patch]") {
  const auto form = GENERATE(LoadPatch::Form::hertz, LoadPatch::Form::linear);
  const Material& material = *GENERATE(&half_plane, &bonded, &sliding);
  const double half_width = GENERATE(0.02, 0.5, 2.0, 9.0);
  CAPTURE(form == LoadPatch::Form::hertz, material.layer.has_value(), half_width);
  const LoadPatch patch{.form = form,
                        .center = 0.3,
                        .half_width = half_width,
                        .normal = 2.0,
                        .tangential = -0.7,
                        .moment = form == LoadPatch::Form::linear ? 0.5 * half_width : 0.0};
  for (const Quantity quantity : line_quantities) {
    const PatchKernel kernel(std::array{quantity}, material, taxel_depth);
    const PadKernel normal(quantity, Traction::normal, material, taxel_depth);
    const PadKernel tangential(quantity, Traction::tangential_y, material, taxel_depth);
    const double scale = is_strain(quantity) ? 1.0 / material.youngs_modulus : 1.0;
    const double tolerance = (material.layer ? 1e-11 : 1e-13) * scale * 2.7;
    const double precision = material.layer ? 1e-12 : 1e-13;
    for (const double y : {-40.0, -2.0, 0.3, 1.1, 9.2, 200.0}) {
      CAPTURE(name(quantity), y);
      CHECK_THAT(reading(kernel, patch, y),
                 WithinAbs(integrated(normal, tangential, patch, y, precision), tolerance));
    }
  }
}

TEST_CASE("a narrow patch far away is a line load at its centre", "[elasticity][patch]") {
  const LoadPatch patch{
      .form = LoadPatch::Form::linear, .center = 1.0, .half_width = 1e-4, .normal = 3.0};
  const PatchKernel kernel(std::array{Quantity::stress_x}, half_plane, taxel_depth);
  const PadKernel line(Quantity::stress_x, Traction::normal, half_plane, taxel_depth);
  CHECK_THAT(reading(kernel, patch, 2.0), WithinRel(3.0 * line(1.0), 1e-8));
}

TEST_CASE("mirrored patches have mirrored readings", "[elasticity][patch]") {
  const auto form = GENERATE(LoadPatch::Form::hertz, LoadPatch::Form::linear);
  const LoadPatch patch{
      .form = form, .center = 0.0, .half_width = 1.2, .normal = 1.0, .moment = 0.25};
  LoadPatch mirrored = patch;
  mirrored.moment = -patch.moment;
  const PatchKernel even(std::array{Quantity::stress_x}, half_plane, taxel_depth);
  const PatchKernel odd(std::array{Quantity::shear_xy}, half_plane, taxel_depth);
  for (const double y : {0.4, 1.3, 5.0, 30.0}) {
    CAPTURE(y);
    CHECK_THAT(reading(even, mirrored, -y), WithinAbs(reading(even, patch, y), 1e-15));
    CHECK_THAT(reading(odd, mirrored, -y), WithinAbs(-reading(odd, patch, y), 1e-15));
  }
}

TEST_CASE("a patch kernel refuses what holds no taxel", "[elasticity][patch]") {
  const std::array reads{Quantity::stress_x};
  CHECK_THROWS_AS(PatchKernel(reads, half_plane, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(PatchKernel(reads, bonded, 2.6), std::invalid_argument);
  CHECK_THROWS_AS(PatchKernel(reads, Material{.youngs_modulus = -1.0}, 1.0), std::invalid_argument);
}
