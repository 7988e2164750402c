/// @file
/// A scene's circuit as the inner solver of a refinement in numbers, and whether that pays.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/allocation.hpp"
#include "tactile_net/network/refinement.hpp"

namespace tactile_net::lab {

/// Typical prices of a channel's converters, in the currency of `PartClass`.
inline constexpr double to_circuit_price = 1.0;
inline constexpr double from_circuit_price = 2.0;

struct CircuitRefinement {
  RefinementOptions options{};
  ToleranceOptions drawn{};  ///< what the builds' resistors are off
  RefinementBound bound{};
  RefinementTrials trials{};
  RefinementVerdict verdict = RefinementVerdict::refused;
  /// After which every build that the verdict speaks of has the accuracy; absent: refused.
  std::optional<std::size_t> proven_cycles{};
  std::optional<double> settling_seconds{};  ///< of the circuit; absent: not known

  /// One way to an answer.
  struct Way {
    enum class Kind {
      alone,         ///< the circuit as it is
      better_parts,  ///< the same with all resistors of a better class, to first order
      refined,
      numbers,  ///< f = M g
    };
    Kind kind = Kind::alone;
    double tolerance = 0.0;           ///< of its resistors; 0: it has none, or each its own
    double error = 0.0;               ///< of 95 of 100 builds, relative
    std::optional<double> price{};    ///< of resistors, op-amps and converters
    std::optional<double> seconds{};  ///< without arithmetic; absent: not known
    std::size_t products = 0;         ///< multiplications in all
    std::size_t cycles = 0;           ///< of `refined`
  };
  std::vector<Way> ways{};
};

/// With the scene's converters, of builds within its tolerances, 1 % where it gives none.
///
/// @pre  the scene asks for it, `NetworkOptions::refine`
/// @throw std::invalid_argument  as `Refinement`
[[nodiscard]] CircuitRefinement refinement(const SceneCircuit& circuit);

}  // namespace tactile_net::lab
