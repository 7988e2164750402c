/// @file
/// What a scene calls for: which effects are simulated, in which order, what is computed and why,
/// and what is left out. `run` follows this very list.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {

/// What the command line asks for beyond the scene.
struct PlanRequest {
  bool compare_rules = false;  ///< every rule for alpha, though one, or none, would do
  bool report = false;         ///< files are written
};

struct PlannedEffect {
  std::string_view name;
  bool simulated = false;
  std::string words{};      ///< what it does here, or what its absence saves
  double operations = 0.0;  ///< floating-point operations for one frame; 0: none
};

enum class Computation {
  readings,       ///< from contacts, through the forward model
  history,        ///< frames before the one that is reconstructed
  tangential,     ///< a second unknown at every taxel
  layer_kernels,  ///< integrals; without a layer kernels are closed formulas
  dft,            ///< each method ...
  tikhonov,
  closed_form,
  rule_comparison,  ///< alpha by every rule
  bands,            ///< the covariance of the tractions
  hidden_modes,     ///< what no reading shows
  circuit,          ///< P, its circuit, and the operating point in the simulator
  certificate,
  transient,
  tolerance,
  time_course,  ///< the resultant in every frame
  report,
};

struct PlannedComputation {
  Computation what = Computation::readings;
  bool done = false;
  std::string why{};   ///< why it is needed, or why it is left out
  std::string cost{};  ///< what it takes; empty where it is left out
};

/// The name as tables and JSON spell it: "rule_comparison".
[[nodiscard]] std::string_view name(Computation computation) noexcept;

struct ScenePlan {
  std::vector<PlannedEffect> effects{};  ///< in the order of the signal path
  std::vector<PlannedComputation> computations{};

  [[nodiscard]] bool does(Computation computation) const noexcept;
};

[[nodiscard]] ScenePlan make_plan(const Scene& scene, const PlanRequest& request = {});

/// Parts that are not ideal, settling or tolerances call for a certificate.
[[nodiscard]] bool calls_for_certificate(const NetworkOptions& options) noexcept;
/// Tolerances are studied for networks of resistors and op-amps.
[[nodiscard]] bool calls_for_tolerance(const NetworkOptions& options) noexcept;

}  // namespace tactile_net::lab
