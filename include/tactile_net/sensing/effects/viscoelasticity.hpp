/// @file
/// A pad that creeps: Young's modulus relaxes over time, Poisson's ratio does not.
///
///     E(t) / E = 1 - sum_i g_i (1 - exp(-t / tau_i))
///
/// the normalised Prony series; E is the material's youngs_modulus, the response to a sudden
/// strain, and E (1 - sum g_i) what is left in the long run. Contacts give tractions, not
/// displacements: by the correspondence principle (Christensen 1982, 2.1) the stresses in the pad
/// are then those of the elastic one at every moment, and the strains creep,
///
///     strain(t) = integral of J(t - s) E d(elastic strain)(s),
///     J(t) E = 1 + sum_j c_j (1 - exp(-t / lambda_j))
///
/// with -1/lambda_j the zeros of the Carson transform 1 - sum g_i / (1 + s tau_i) of E(t)/E
/// (Park and Schapery 1999). A pad on a rigid base is no exception.
#pragma once

#include <memory>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

struct PronyTerm {
  double fraction = 0.0;  ///< g, of the modulus, >= 0; all together < 1
  double time = 1.0;      ///< relaxation time tau [s], > 0
};

struct Viscoelasticity {
  std::vector<PronyTerm> terms{};
};

/// The load is zero before t = 0.
[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Viscoelasticity& viscoelasticity,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
