#include "elasticity/space/plane_wave.hpp"

#include <cmath>
#include <limits>

#include "tactile_net/elasticity/pad_kernel.hpp"

namespace tactile_net {
namespace {

PlaneWave uniform_wave(const Material& material, double depth) noexcept {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nu = material.poisson_ratio;
  const auto sagittal = [&](Traction load, double u_x, double u_along) -> SagittalAmplitudes {
    const auto stress = [&](Quantity quantity) {
      const auto value = pad_transform(quantity, load, material, depth, 0.0);
      return is_odd(quantity, load) ? -value.imag() : value.real();
    };
    return {stress(Quantity::stress_x), stress(Quantity::stress_y), stress(Quantity::shear_xy), u_x,
            u_along};
  };
  const auto wave = [&](double pressed, double dragged, const AntiPlaneAmplitudes& across) {
    return PlaneWave{sagittal(Traction::normal, pressed, 0.0),
                     sagittal(Traction::tangential_y, 0.0, dragged), across};
  };
  if (!material.layer) return wave(infinity, infinity, {1.0, 0.0, infinity});
  const double h = material.layer->thickness;
  const double rest = h - depth;
  if (material.layer->base == Base::frictionless)
    return wave((1.0 - nu) * rest, infinity, {rest / h, 0.0, infinity});
  return wave((1.0 - 2.0 * nu) * rest / (1.0 - nu), 2.0 * rest, {1.0, 0.0, 2.0 * rest});
}

}  // namespace

PlaneWave plane_wave(const Material& material, double depth, double wavenumber) noexcept {
  const double k = wavenumber;
  if (k == 0.0) return uniform_wave(material, depth);
  const double nu = material.poisson_ratio;
  // Else the base is exp(-800) away.
  const bool has_base = material.layer && !(k * (material.layer->thickness - depth) > 400.0);
  // exp(-k depth) is zero; k depth may be infinite.
  if (has_base ? k * depth > 745.0 : std::exp(-k * depth) == 0.0) return {};
  PlaneWave wave = has_base ? layer_wave(nu, LayerFunctions(material.layer->thickness, depth, k),
                                         material.layer->base == Base::bonded)
                            : half_space_wave(nu, k * depth);
  for (SagittalAmplitudes* const f : {&wave.normal, &wave.tangential}) {
    f->displacement_x /= k;
    f->displacement_along /= k;
  }
  wave.across.displacement /= k;
  return wave;
}

}  // namespace tactile_net
