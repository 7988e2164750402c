/// @file
/// How much softer or stiffer than a half space a layer's surface is, wave by wave. Private.
#pragma once

#include <cmath>

#include "calibration/wave_nodes.hpp"
#include "numeric/dual.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// H = k h up to which what follows counts: it is exp(-2 H) H^2 there.
inline constexpr double largest_compliance_wave = 20.0;

/// Compliance of the layer over that of the half space, minus 1: the formulas of rod_contact.hpp.
/// Plane strain and space have the same. With its slope by nu.
inline Dual<1> compliance_change(Base base, const Dual<1>& nu, double H) {
  const double decay = std::exp(-2.0 * H);  // of cosh 2H and sinh 2H, both times it
  const double cosh = 0.5 * (1.0 + decay * decay);
  const double sinh = -0.5 * std::expm1(-4.0 * H);
  if (base == Base::frictionless)
    return (cosh - decay - sinh - 2.0 * H * decay) / (sinh + 2.0 * H * decay);
  const Dual<1> kappa = 3.0 - 4.0 * nu;
  const Dual<1> below = kappa * cosh + (2.0 * H * H + 5.0 - 12.0 * nu + 8.0 * nu * nu) * decay;
  return (kappa * sinh - 2.0 * H * decay) / below - 1.0;
}

/// Calls of(H, weight, change of the compliance) for the waves that a layer changes.
template <class Of>
void each_changed_wave(Base base, double nu, const Of& of) {
  constexpr int panels = 5;
  constexpr double width = largest_compliance_wave / panels;
  for (int panel = 0; panel < panels; ++panel)
    each_point(panel * width, width, [&](double H, double weight) {
      of(H, weight, compliance_change(base, Dual<1>::seed(nu, 0), H));
    });
}

}  // namespace tactile_net
