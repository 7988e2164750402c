/// @file
/// What a scene calls for: which effects are simulated, in which order, what is computed and why,
/// and what is left out. `run` follows this very list; `report::print_workload` tells it.
///
///     const lab::Workload work = lab::workload(scene, {.report = true});
///     if (work.does(lab::Computation::circuit)) ...
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::lab {

/// What the caller asks for beyond the scene.
struct WorkloadRequest {
  bool compare_rules = false;  ///< every rule for alpha, though one, or none, would do
  bool report = false;         ///< files are written
};

enum class Computation {
  readings,       ///< from contacts, through the forward model
  history,        ///< frames before the one that is reconstructed
  tangential,     ///< a second unknown at every place
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

/// The name as tables and JSON spell it: "rule_comparison".
[[nodiscard]] std::string_view name(Computation computation) noexcept;

struct Workload {
  struct Effect {
    const SceneEffect* row = nullptr;  ///< which: one of `scene_effects()`
    bool simulated = false;
    bool idle = false;        ///< simulated with strength 0: it makes no stage
    double operations = 0.0;  ///< floating-point operations for one frame; 0: none
  };

  /// Why a computation is needed, or why it is left out.
  enum class Reason {
    // readings
    exact_model,
    sampled_model,
    // history
    effects_remember,   ///< what came before the frame
    only_draws_matter,  ///< no effect remembers; random draws of earlier frames are made
    no_time,
    first_frame,
    // tangential
    two_tractions,
    one_channel,  ///< one quantity at one depth tells the normal traction alone
    tangential_excluded,
    no_friction,
    // layer_kernels
    layer,
    half_plane,
    // the methods, and the circuit
    method_named,
    method_not_named,
    // rule_comparison
    rule_chooses,  ///< `Why::rule`, whose verdict hears the others
    comparison_requested,
    alpha_given,
    no_method_takes_alpha,
    // bands, hidden_modes, time_course
    forces_have_deviations,
    hidden_must_be_said,
    no_matrix_method,  ///< neither tikhonov nor closed_form
    array_too_large,
    // certificate, transient, tolerance
    parts_not_ideal,  ///< or settling or tolerances are asked for
    parts_ideal,
    settling_requested,
    settling_not_requested,
    tolerance_requested,
    tolerance_unsupported,  ///< only networks of resistors and op-amps are studied
    nominal_parts,          ///< every component has its value
    no_circuit,
    // time_course, report
    resultant_drawn,  ///< over the scene's time
    one_frame,
    report_requested,
    no_report,
  };
  struct Why {
    Reason reason = Reason::exact_model;
    std::size_t frame = 0;            ///< effects_remember: the one that is reconstructed
    std::optional<AlphaRule> rule{};  ///< rule_chooses; absent: `default_rule`
  };

  /// What a computation takes. Each kind says what its count, rows and columns are of; those it
  /// does not name are 0.
  struct Cost {
    enum class Kind {
      kernel_values,     ///< some hundred for each contact and each of `count` readings
      direct_sum,        ///< rows x columns, for `count` kernels
      fft,               ///< for `count` kernels
      moments,           ///< readings at `count` of them
      random_draws,      ///< no reading is computed
      unknowns,          ///< `count` of them instead of `rows`
      kernel_integrals,  ///< at `count` distances for each kernel
      frame_fft,
      decompositions,       ///< QR and SVD of rows x columns, once
      product,              ///< QR and SVD, once; then one matrix-vector product a frame
      conjugate_gradients,  ///< by FFT
      alpha_rules,          ///< SVD; 200 values of alpha by `count` rules
      inverse,              ///< of rows x columns, and one rule for alpha
      singular_values,      ///< SVD of rows x columns
      circuit,              ///< P on `rows` nodes with up to `count` branches; an operating point
      certificate,
      transient,
      draws,        ///< `count` of them
      every_frame,  ///< simulated and solved, at most 400 solved
      drawing,
    };
    Kind kind = Kind::drawing;
    std::size_t count = 0;
    std::size_t rows = 0;
    std::size_t columns = 0;
    double operations = 0.0;                   ///< floating-point, where they are known
    std::optional<Realization> realization{};  ///< circuit
  };

  struct Task {
    Computation what = Computation::readings;
    bool done = false;
    Why why{};
    std::optional<Cost> cost{};  ///< absent where it is left out
  };

  std::vector<Effect> effects{};  ///< in the order of the signal path
  std::vector<Task> tasks{};      ///< every computation once, in the order of `Computation`

  [[nodiscard]] bool does(Computation computation) const noexcept;
};

/// Computes nothing but counts.
[[nodiscard]] Workload workload(const Scene& scene, const WorkloadRequest& request = {});

/// Parts that are not ideal, settling or tolerances call for a certificate.
[[nodiscard]] bool calls_for_certificate(const NetworkOptions& options) noexcept;
/// Tolerances are studied for networks of resistors and op-amps.
[[nodiscard]] bool calls_for_tolerance(const NetworkOptions& options) noexcept;

}  // namespace tactile_net::lab
