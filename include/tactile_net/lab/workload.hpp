/// @file
/// What a scene of a line or of a skin calls for: which effects are simulated, in which order, what
/// is computed and why, and what is left out. `run` of a line follows this very list;
/// `report::print_workload` tells it.
///
///     const lab::Workload work = lab::workload(scene, {.report = true});
///     if (work.does(lab::Computation::circuit)) ...
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::lab {

/// What the caller asks for beyond the scene.
struct WorkloadRequest {
  bool compare_rules = false;  ///< every rule for alpha, though one, or none, would do
  bool report = false;         ///< files are written
};

/// What a run may compute: `computations` says what each is.
enum class Computation {
  readings,
  history,
  tangential,
  layer_kernels,
  weights,
  dft,
  tikhonov,
  closed_form,
  rule_comparison,
  alpha_rule,
  constraints,
  bands,
  hidden_modes,
  data_verdict,
  circuit,
  certificate,
  transient,
  tolerance,
  time_course,
  report,
};

/// Why a computation is needed, or why it is left out: `workload_reasons` says it.
enum class WorkloadReason {
  // readings
  exact_model,
  sampled_model,
  // history
  effects_remember,
  only_draws_matter,
  no_time,
  first_frame,
  // tangential
  two_tractions,
  three_tractions,
  one_channel,
  tangential_excluded,
  no_friction,
  // layer_kernels
  layer,
  half_plane,
  // weights
  weight_unknown,
  weight_given,
  one_traction,
  // the methods, and the circuit
  method_named,
  method_not_named,
  matrix_held,
  matrix_too_large,
  // rule_comparison
  rules_judge,
  comparison_requested,
  alpha_given,
  no_method_takes_alpha,
  // alpha_rule
  rule_chooses,
  prior_by_rule,
  // constraints
  limits_stated,
  no_limits,
  limits_of_tikhonov,
  // bands, hidden_modes, data_verdict
  forces_have_deviations,
  hidden_must_be_said,
  noise_stated,
  no_noise,
  no_matrix_method,
  array_too_large,
  // certificate, transient, tolerance
  parts_not_ideal,
  parts_ideal,
  settling_requested,
  settling_not_requested,
  tolerance_requested,
  tolerance_unsupported,
  nominal_parts,
  no_circuit,
  // time_course, report
  resultant_drawn,
  one_frame,
  report_requested,
  no_report,
};

/// What a computation takes: `workload_costs` says it.
enum class WorkloadCost {
  kernel_values,
  direct_sum,
  fft,
  sum,
  moments,
  random_draws,
  unknowns,
  kernel_integrals,
  families,
  frame_fft,
  decompositions,
  product,
  conjugate_gradients,
  classes,
  tiles,
  alpha_rules,
  one_rule,
  probes,
  active_set,
  multipliers,
  projected_gradients,
  inverse,
  class_sums,
  solves,
  singular_values,
  contact_search,
  circuit,
  certificate,
  transient,
  draws,
  every_frame,
  drawing,
};

struct Workload {
  struct Effect {
    const SceneEffect* row = nullptr;  ///< which: one of `scene_effects()`
    bool simulated = false;
    bool idle = false;        ///< simulated with strength 0: it makes no stage
    double operations = 0.0;  ///< floating-point operations for one frame; 0: none
  };

  struct Why {
    WorkloadReason reason = WorkloadReason::exact_model;
    std::size_t frame = 0;            ///< effects_remember: the one that is reconstructed
    std::optional<AlphaRule> rule{};  ///< of the reasons with one; absent: `default_rule`
  };

  /// The kind says what its numbers are of; those it does not name are 0.
  struct Cost {
    WorkloadCost kind = WorkloadCost::drawing;
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
  /// In the order of `Computation`, each that there is for the scene's sensor once.
  std::vector<Task> tasks{};

  /// Null: there is none for the scene's sensor.
  [[nodiscard]] const Task* task(Computation computation) const noexcept;
  [[nodiscard]] bool does(Computation computation) const noexcept;
};

/// The name as tables and JSON spell it: "rule_comparison".
[[nodiscard]] std::string_view name(Computation computation) noexcept;

/// Computes nothing but counts.
///
/// @throw std::invalid_argument  of a skin as `grid`
[[nodiscard]] Workload workload(const Scene& scene, const WorkloadRequest& request = {});
[[nodiscard]] Workload workload(const SkinScene& scene, const WorkloadRequest& request = {});

/// Parts that are not ideal, settling or tolerances call for a certificate.
[[nodiscard]] bool calls_for_certificate(const NetworkOptions& options) noexcept;
/// Tolerances are studied for networks of resistors and op-amps.
[[nodiscard]] bool calls_for_tolerance(const NetworkOptions& options) noexcept;

inline constexpr Enumerator<Computation> computations[] = {
    {Computation::readings, "readings", "The readings, from contacts through the forward model."},
    {Computation::history, "history", "The frames before the one that is reconstructed."},
    {Computation::tangential, "tangential", "Tangential tractions, beside the normal one."},
    {Computation::layer_kernels, "layer_kernels", "The kernels of a layer, by integrals."},
    {Computation::weights, "weights",
     "The weight of tangential tractions against the normal one, estimated from the readings."},
    {Computation::dft, "dft", "The tractions by the method dft."},
    {Computation::tikhonov, "tikhonov", "The tractions by the method tikhonov."},
    {Computation::closed_form, "closed_form", "The tractions by the method closed_form."},
    {Computation::rule_comparison, "rule_comparison", "The alpha of every rule, to compare them."},
    {Computation::alpha_rule, "alpha_rule", "One rule's alpha, for the tractions or their bands."},
    {Computation::constraints, "constraints",
     "Tractions that do not pull, and drag no more than friction lets them."},
    {Computation::bands, "bands", "How far tractions and forces may be off."},
    {Computation::hidden_modes, "hidden_modes", "What no reading shows of the tractions."},
    {Computation::data_verdict, "data_verdict", "Whether any contact explains the readings."},
    {Computation::circuit, "circuit", "The network, and its operating point in the simulator."},
    {Computation::certificate, "certificate", "Whether the network is stable, and how surely."},
    {Computation::transient, "transient", "How the network settles, in the simulator."},
    {Computation::tolerance, "tolerance", "What the tolerances of parts do to the answer."},
    {Computation::time_course, "time_course", "The resultant in every frame."},
    {Computation::report, "report", "The page and its files."}};

/// `{frame}` and `{rule}` stand for those of `Why`.
inline constexpr Enumerator<WorkloadReason> workload_reasons[] = {
    {WorkloadReason::exact_model, "exact_model",
     "forward model exact: integrals over the contacts"},
    {WorkloadReason::sampled_model, "sampled_model",
     "forward model sampled: sums over tractions on a grid"},
    {WorkloadReason::effects_remember, "effects_remember",
     "effects remember what came before frame {frame}"},
    {WorkloadReason::only_draws_matter, "only_draws_matter",
     "no effect remembers: of earlier frames only their random draws"},
    {WorkloadReason::no_time, "no_time", "no [time]: one frame"},
    {WorkloadReason::first_frame, "first_frame", "the first frame is reconstructed"},
    {WorkloadReason::two_tractions, "two_tractions", "both tractions are to be found"},
    {WorkloadReason::three_tractions, "three_tractions", "all three tractions are to be found"},
    {WorkloadReason::one_channel, "one_channel",
     "one quantity at one depth tells the normal traction alone"},
    {WorkloadReason::tangential_excluded, "tangential_excluded", "tangential = false"},
    {WorkloadReason::no_friction, "no_friction", "no friction: the normal traction alone"},
    {WorkloadReason::layer, "layer", "[material] has a layer"},
    {WorkloadReason::half_plane, "half_plane", "no layer: half plane, closed formulas"},
    {WorkloadReason::weight_unknown, "weight_unknown",
     "tangential_weight = \"evidence\": each frame says how small its drags are"},
    {WorkloadReason::weight_given, "weight_given",
     "tangential_weight is a number, 1 if it is left out"},
    {WorkloadReason::one_traction, "one_traction", "the normal traction alone"},
    {WorkloadReason::method_named, "method_named", "reconstruct.methods names it"},
    {WorkloadReason::method_not_named, "method_not_named", "reconstruct.methods does not name it"},
    {WorkloadReason::matrix_held, "matrix_held",
     "at most 8192 tractions: the whole matrix is stored"},
    {WorkloadReason::matrix_too_large, "matrix_too_large",
     "more than 8192 tractions: by products, without a matrix"},
    {WorkloadReason::rules_judge, "rules_judge",
     "alpha is chosen by {rule}; it is flagged if the other rules disagree"},
    {WorkloadReason::comparison_requested, "comparison_requested",
     "a comparison of the rules is asked for"},
    {WorkloadReason::alpha_given, "alpha_given", "alpha is given"},
    {WorkloadReason::no_method_takes_alpha, "no_method_takes_alpha",
     "no method takes alpha from it"},
    {WorkloadReason::rule_chooses, "rule_chooses", "alpha is chosen by {rule}"},
    {WorkloadReason::prior_by_rule, "prior_by_rule",
     "alpha is given; the prior of the bands is chosen by {rule}"},
    {WorkloadReason::limits_stated, "limits_stated", "friction_limit or nonnegative asks for it"},
    {WorkloadReason::no_limits, "no_limits", "neither friction_limit nor nonnegative"},
    {WorkloadReason::limits_of_tikhonov, "limits_of_tikhonov",
     "only tikhonov knows constraints, and reconstruct.methods does not name it"},
    {WorkloadReason::forces_have_deviations, "forces_have_deviations",
     "tractions and forces have deviations"},
    {WorkloadReason::hidden_must_be_said, "hidden_must_be_said",
     "combinations that no reading shows must be named"},
    {WorkloadReason::noise_stated, "noise_stated",
     "it must be said whether any contact explains the readings"},
    {WorkloadReason::no_noise, "no_noise",
     "without a stated noise only the readings' size is judged"},
    {WorkloadReason::no_matrix_method, "no_matrix_method",
     "neither tikhonov nor closed_form is asked for"},
    {WorkloadReason::array_too_large, "array_too_large",
     "no matrix is formed for an array as large as this"},
    {WorkloadReason::parts_not_ideal, "parts_not_ideal",
     "parts are not ideal, or settling or tolerances are asked for"},
    {WorkloadReason::parts_ideal, "parts_ideal", "ideal parts"},
    {WorkloadReason::settling_requested, "settling_requested", "network.settling asks for it"},
    {WorkloadReason::settling_not_requested, "settling_not_requested", "settling is not asked for"},
    {WorkloadReason::tolerance_requested, "tolerance_requested", "network.tolerance asks for it"},
    {WorkloadReason::tolerance_unsupported, "tolerance_unsupported",
     "tolerances are studied for networks of resistors and op-amps"},
    {WorkloadReason::nominal_parts, "nominal_parts", "every component has its value"},
    {WorkloadReason::no_circuit, "no_circuit", "no circuit"},
    {WorkloadReason::resultant_drawn, "resultant_drawn",
     "the report draws the resultant over the scene's time"},
    {WorkloadReason::one_frame, "one_frame", "one frame"},
    {WorkloadReason::report_requested, "report_requested", "a report is asked for"},
    {WorkloadReason::no_report, "no_report", "no report is asked for"}};

/// `{count}` stands for a number of `Cost`, `{count reading}` for that number of readings.
inline constexpr Enumerator<WorkloadCost> workload_costs[] = {
    {WorkloadCost::kernel_values, "kernel_values",
     "some hundred kernel values for each of {count reading} and contact"},
    {WorkloadCost::direct_sum, "direct_sum",
     "{rows} x {columns} sum for {count kernel}, about {operations} operations"},
    {WorkloadCost::fft, "fft", "FFT for {count kernel}, about {operations} operations"},
    {WorkloadCost::sum, "sum", "products with {count traction}"},
    {WorkloadCost::moments, "moments", "the readings at {count moment}"},
    {WorkloadCost::random_draws, "random_draws", "no reading is computed"},
    {WorkloadCost::unknowns, "unknowns", "{count unknown} instead of {rows}"},
    {WorkloadCost::kernel_integrals, "kernel_integrals",
     "integrals at {count} distances for each kernel"},
    {WorkloadCost::families, "families", "a decomposition for each of some six weights"},
    {WorkloadCost::frame_fft, "frame_fft", "FFT, about {operations} operations a frame"},
    {WorkloadCost::decompositions, "decompositions",
     "QR and SVD of {rows} x {columns}, once; about {operations} operations a frame"},
    {WorkloadCost::product, "product", "QR and SVD, once; about {operations} operations a frame"},
    {WorkloadCost::conjugate_gradients, "conjugate_gradients", "conjugate gradients by FFT"},
    {WorkloadCost::classes, "classes",
     "singular values of {rows} x {columns}, in up to four classes"},
    {WorkloadCost::tiles, "tiles",
     "conjugate gradients by FFT for {count traction}, preconditioned by overlapping tiles: some "
     "tens of steps"},
    {WorkloadCost::alpha_rules, "alpha_rules", "SVD; 200 values of alpha by {count} rules"},
    {WorkloadCost::one_rule, "one_rule", "200 values of alpha by one rule"},
    {WorkloadCost::probes, "probes",
     "four random probes and a run of the frame, each up to 300 products with K and K'"},
    {WorkloadCost::active_set, "active_set",
     "QR of {rows} x {columns}, once; some exchanges of what is held at zero a frame"},
    {WorkloadCost::multipliers, "multipliers", "ADMM with one decomposition"},
    {WorkloadCost::projected_gradients, "projected_gradients",
     "accelerated gradients by FFT, 2000 steps at most"},
    {WorkloadCost::inverse, "inverse", "one rule for alpha, and the inverse of {rows} x {columns}"},
    {WorkloadCost::class_sums, "class_sums", "sums over the singular values"},
    {WorkloadCost::solves, "solves",
     "a solve for each force and moment that is new, and two to six to say how far bands of cells "
     "are off"},
    {WorkloadCost::singular_values, "singular_values", "SVD of {rows} x {columns}"},
    {WorkloadCost::contact_search, "contact_search",
     "where tractions that only press leave too much, a search for contacts that do not"},
    {WorkloadCost::circuit, "circuit",
     "P, {rows node}, {realization}, up to {count} branches; one operating point in ngspice"},
    {WorkloadCost::certificate, "certificate", "theorem, margin, poles"},
    {WorkloadCost::transient, "transient", "a transient in ngspice"},
    {WorkloadCost::draws, "draws", "{count draw}"},
    {WorkloadCost::every_frame, "every_frame",
     "every frame simulated and solved, at most 400 solved"},
    {WorkloadCost::drawing, "drawing", "plots and tables"}};

}  // namespace tactile_net::lab

namespace tactile_net {

template <>
struct Enumerators<lab::Computation> {
  static constexpr const auto& all = lab::computations;
};
template <>
struct Enumerators<lab::WorkloadReason> {
  static constexpr const auto& all = lab::workload_reasons;
};
template <>
struct Enumerators<lab::WorkloadCost> {
  static constexpr const auto& all = lab::workload_costs;
};

}  // namespace tactile_net
