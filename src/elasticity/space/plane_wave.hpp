/// @file
/// A skin under a plane wave of tractions, in the wave's own frame. Private.
#pragma once

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// What a traction p or q_L = q along the wave vector of unit amplitude causes in the plane of x
/// and the wave vector: plane strain, as under a line array. Displacements times 2 G.
///
/// Real numbers: under p the shear stress and displacement_along, under q_L the other three, carry
/// a factor -i.
struct SagittalAmplitudes {
  double stress_x = 0.0;
  double stress_along = 0.0;
  double shear = 0.0;
  double displacement_x = 0.0;
  double displacement_along = 0.0;
};

/// What a traction q_T across the wave vector causes: the stress between the wave vector and the
/// direction across carries a factor -i.
struct AntiPlaneAmplitudes {
  double shear = 0.0;
  double shear_along = 0.0;
  double displacement = 0.0;
};

struct PlaneWave {
  SagittalAmplitudes normal{};
  SagittalAmplitudes tangential{};
  AntiPlaneAmplitudes across{};
};

/// @param wavenumber  k >= 0 [1/m]. At 0 an amplitude is the limit where there is one; poles that
///                    carry -i have their principal value 0 and the others infinity.
[[nodiscard]] PlaneWave plane_wave(const Material& material, double depth,
                                   double wavenumber) noexcept;

}  // namespace tactile_net
