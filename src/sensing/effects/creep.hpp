/// @file
/// The laws of a pad that creeps (viscoelasticity.hpp). Private.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/sensing/effects/viscoelasticity.hpp"

namespace tactile_net {

/// E(t) / E for t >= 0 [s].
[[nodiscard]] double relaxation(std::span<const PronyTerm> terms, double t) noexcept;

struct CreepTerm {
  double compliance = 0.0;  ///< c, over 1/E
  double time = 1.0;        ///< retardation time lambda [s]
};

/// The creep of a Prony series; terms of equal relaxation time count as one, those of fraction 0
/// do not count.
[[nodiscard]] std::vector<CreepTerm> creep_terms(std::span<const PronyTerm> terms);

/// J(t) E for t >= 0 [s].
[[nodiscard]] double creep(std::span<const CreepTerm> terms, double t) noexcept;

}  // namespace tactile_net
