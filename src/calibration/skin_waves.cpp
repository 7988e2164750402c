#include "calibration/skin_waves.hpp"

#include "elasticity/space/plane_wave.hpp"

namespace tactile_net {
namespace {

using Amplitude = SkinAmplitude;
using enum SkinWave;
using Terms = std::array<std::vector<SkinTerm>, skin_quantities.size()>;

/// In the order of the quantities.
const Terms normal_terms = {{
    {{stress_x}},
    {{trace}, {deviator}},
    {{trace}, {deviator, false, -1.0}},
    {{shear}},
    {{shear, true}},
    {{deviator, true}},
    {{strain_x}},
    {{strain_trace}, {strain_deviator}},
    {{strain_trace}, {strain_deviator, false, -1.0}},
    {{shear_strain}},
    {{shear_strain, true}},
    {{strain_deviator, true, 2.0}},
    {{displacement_x}},
    {{displacement_along}},
    {{displacement_along, true}},
}};

const Terms drag_terms = {{
    {{drag_stress_x}},
    {{drag_trace}, {drag_deviator}, {drag_deviator_turned}},
    {{drag_trace}, {drag_deviator, false, -1.0}, {drag_deviator_turned, false, -1.0}},
    {{drag_shear}, {drag_shear_turned}},
    {{drag_shear_turned, true}},
    {{drag_deviator, true}, {drag_deviator_turned, true}},
    {{drag_strain_x}},
    {{drag_strain_trace}, {drag_strain_deviator}, {drag_strain_deviator_turned}},
    {{drag_strain_trace},
     {drag_strain_deviator, false, -1.0},
     {drag_strain_deviator_turned, false, -1.0}},
    {{drag_shear_strain}, {drag_shear_strain_turned}},
    {{drag_shear_strain_turned, true}},
    {{drag_strain_deviator, true, 2.0}, {drag_strain_deviator_turned, true, 2.0}},
    {{drag_displacement_x}},
    {{drag_displacement}, {drag_displacement_turned}},
    {{drag_displacement_turned, true}},
}};

}  // namespace

const std::vector<SkinTerm>& skin_terms(Quantity quantity, Traction traction) {
  return (traction == Traction::normal ? normal_terms
                                       : drag_terms)[static_cast<std::size_t>(quantity)];
}

std::array<SkinAmplitude, skin_wave_count> skin_amplitudes(const Material& material, double depth,
                                                           double k, bool drags) {
  const Amplitude x = Amplitude::seed(depth, 0);
  const Amplitude nu = Amplitude::seed(material.poisson_ratio, 2);
  const double modulus = material.youngs_modulus;
  PlaneWaveOf<Amplitude> wave;
  if (!material.layer || k * (material.layer->thickness - depth) > 400.0) {
    wave = half_space_wave(nu, k * x, drags);
  } else {
    const Amplitude h = Amplitude::seed(material.layer->thickness, 1);
    wave = layer_wave(nu, LayerFunctionsOf<Amplitude>(h, x, k),
                      material.layer->base == Base::bonded, drags);
  }
  const auto f = round_amplitudes(wave, nu);
  const Amplitude compliance = (1.0 + nu) / modulus;  // 1 / 2 G
  std::array<SkinAmplitude, skin_wave_count> all;
  // Stresses, strains and displacements under one load, in the order of the waves: stress_x, n
  // shears, the trace and n deviators; the strains alike; u_x and n displacements along the skin.
  const auto set = [&](std::size_t waves, std::size_t functions, std::size_t n) {
    const std::size_t stresses = 2 + 2 * n;
    const Amplitude* const stress = f.data() + functions;
    Amplitude* const strain = all.data() + waves + stresses;
    const Amplitude& trace = stress[1 + n];
    for (std::size_t i = 0; i < stresses; ++i) all[waves + i] = k * stress[i];
    strain[0] = k * (stress[0] - 2.0 * nu * trace) / modulus;
    strain[1 + n] = k * ((1.0 - nu) * trace - nu * stress[0]) / modulus;
    for (std::size_t i = 1; i <= n; ++i) {
      strain[i] = 2.0 * k * compliance * stress[i];
      strain[1 + n + i] = k * compliance * stress[1 + n + i];
    }
    for (std::size_t i = 0; i <= n; ++i) strain[stresses + i] = compliance * stress[stresses + i];
  };
  set(0, 0, 1);
  if (drags) set(first_drag_wave, 6, 2);
  return all;
}

}  // namespace tactile_net
