/// @file
/// Which realisation to build from parts that are not exact.
#pragma once

#include <optional>
#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/tolerance.hpp"

namespace tactile_net::lab {

/// Which realisation for the scene's tolerances, from 200 draws of each; fewer of a large network.
struct Recommendation {
  struct Candidate {
    Realization realization = Realization::nic;
    bool ladder = false;  ///< see `has_ladder`
    std::size_t opamps = 0;
    /// With everything that the scene states. One that is not known to be stable is never chosen.
    StabilityVerdict stability{};
    ToleranceResult tolerance{};

    [[nodiscard]] bool stable() const noexcept { return stability.stability == Stability::stable; }
  };
  enum class Outcome {
    no_load,       ///< nothing for errors of components to change: nothing was drawn
    reached,       ///< `choice` has the fewest op-amps of those that reach the accuracy
    none_reaches,  ///< no candidate does; `choice` is stable and comes nearest
    none_stable,   ///< of no candidate it is known that it is stable with the scene's op-amps
  };
  Outcome outcome = Outcome::no_load;
  std::optional<std::size_t>
      choice{};  ///< index into `candidates`; absent: no load, or none is stable
  std::vector<Candidate> candidates{};  ///< the fewest op-amps first, of those the surest
  ToleranceOptions drawn{};             ///< what was drawn, and the accuracy that counts
  bool inverters_replaced = false;      ///< by complementary outputs, where the scene has inverters
  /// none_reaches: relative errors of parts with which `choice` would reach it, to first order;
  /// absent where a series gives the errors, or most builds are unstable.
  std::optional<double> parts_needed{};

  /// @pre there is a choice
  [[nodiscard]] const Candidate& chosen() const { return candidates[*choice]; }
};

/// A candidate reaches an accuracy if 95 of 100 builds do.
[[nodiscard]] Recommendation recommend(const SceneCircuit& circuit);

}  // namespace tactile_net::lab
