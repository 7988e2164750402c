#include "tactile_net/lab/workload.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/named.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/scene/skin_size.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net::lab {
namespace {

using Reason = WorkloadReason;
using Why = Workload::Why;
using Cost = Workload::Cost;
using CostKind = WorkloadCost;

/// Sizes that costs are made of, and what a scene's problem says before anything is made.
struct Sizes {
  std::size_t unknowns = 0;  ///< of each place
  std::size_t places = 0;
  bool drags = false;
  bool is_large = false;
  bool estimates_weight = false;
  bool has_limits = false;
  bool knows_noise = false;
  std::size_t tractions = unknowns * places;
};

Sizes sizes_of(const Scene& scene) {
  const SceneProblem problem(scene);
  return {.unknowns = unknowns(scene),
          .places = problem.surface().count,
          .drags = any_friction(scene),
          .is_large = problem.is_large(),
          .estimates_weight = problem.estimates_weight(),
          .has_limits = problem.constraints().has_value(),
          .knows_noise = problem.stated_noise().has_value()};
}

Sizes sizes_of(const SkinScene& scene) {
  const SkinSceneProblem problem(scene);
  return {.unknowns = components(scene),
          .places = grid(scene).count(),
          .drags = any_drag(scene),
          .is_large = is_large(scene),
          // A mixture has all weights in it.
          .estimates_weight = problem.estimates_weight() &&
                              (problem.constraints() || !problem.answers_by_mixture()),
          .has_limits = problem.constraints().has_value(),
          .knows_noise = problem.stated_noise().has_value()};
}

SignalLayout layout_of(const Scene& scene) { return scene.sensor; }
SignalLayout layout_of(const SkinScene& scene) { return signal_layout(scene.sensor); }

/// What the work on a line and on a skin have in common.
class Counter {
 public:
  Counter(const WorkloadRequest& request, const Sizes& sizes, const auto& scene)
      : request_(request),
        sizes_(sizes),
        readings_(reading_count(scene.sensor)),
        channels_(channel_count(scene.sensor)) {}

 protected:
  void add(Computation what, bool done, const Why& why, const Cost& cost) {
    work_.tasks.push_back({what, done, why, done ? std::optional(cost) : std::nullopt});
  }

  void effects(const auto& scene) {
    const SignalLayout layout = layout_of(scene);
    for (const SceneEffect& effect : scene_effects()) {
      Workload::Effect work{.row = &effect, .simulated = effect.present(scene)};
      if (work.simulated) {
        work.idle = effect.make != nullptr && effect.make(scene, layout) == nullptr;
        if (!work.idle) work.operations = effect.operations(scene) * static_cast<double>(readings_);
      }
      work_.effects.push_back(work);
    }
  }

  void history(const auto& scene) {
    const std::size_t frames = scene.frame + 1;
    const std::size_t moments = instants(scene).size();
    const bool memory = moments > frames || signal_path(scene).has_memory();
    Why why{!scene.time   ? Reason::no_time
            : frames == 1 ? Reason::first_frame
            : memory      ? Reason::effects_remember
                          : Reason::only_draws_matter};
    if (why.reason == Reason::effects_remember) why.frame = scene.frame;
    add(Computation::history, frames > 1, why,
        memory ? Cost{.kind = CostKind::moments, .count = moments} : Cost{CostKind::random_draws});
  }

  void tangential(const auto& scene) {
    add(Computation::tangential, sizes_.unknowns > 1,
        {sizes_.unknowns == 2           ? Reason::two_tractions
         : sizes_.unknowns == 3         ? Reason::three_tractions
         : channels_ == 1               ? Reason::one_channel
         : scene.reconstruct.tangential ? Reason::tangential_excluded
                                        : Reason::no_friction},
        {.kind = CostKind::unknowns, .count = sizes_.tractions, .rows = sizes_.places});
  }

  void weights() {
    add(Computation::weights, sizes_.estimates_weight,
        {sizes_.unknowns == 1      ? Reason::one_traction
         : sizes_.estimates_weight ? Reason::weight_unknown
                                   : Reason::weight_given},
        {CostKind::families});
  }

  void report() {
    add(Computation::report, request_.report,
        {request_.report ? Reason::report_requested : Reason::no_report}, {CostKind::drawing});
  }

  const WorkloadRequest& request_;
  Sizes sizes_;
  std::size_t readings_;
  std::size_t channels_;
  Workload work_{};
};

class LineCounter : Counter {
 public:
  LineCounter(const Scene& scene, const WorkloadRequest& request)
      : Counter(request, sizes_of(scene), scene),
        scene_(scene),
        options_(scene.reconstruct),
        with_matrix_(uses(Method::tikhonov) || uses(Method::closed_form)) {}

  Workload work() {
    effects(scene_);
    readings();
    history(scene_);
    tangential(scene_);
    const bool layer = scene_.material.layer.has_value();
    add(Computation::layer_kernels, layer, {layer ? Reason::layer : Reason::half_plane},
        {.kind = CostKind::kernel_integrals, .count = 2 * sizes_.places - 1});
    weights();
    methods();
    rule_comparison();
    errors();
    circuit();
    time_course();
    report();
    return std::move(work_);
  }

 private:
  [[nodiscard]] bool uses(Method method) const {
    return std::find(options_.methods.begin(), options_.methods.end(), method) !=
           options_.methods.end();
  }
  [[nodiscard]] Why named(Method method) const {
    return {uses(method) ? Reason::method_named : Reason::method_not_named};
  }

  void readings() {
    const std::size_t count = scene_.sensor.count;
    const std::size_t kernels = channels_ * (sizes_.drags ? 2 : 1);
    const auto n = static_cast<double>(count);
    if (scene_.forward == ForwardModel::exact)
      add(Computation::readings, true, {Reason::exact_model},
          {.kind = CostKind::kernel_values, .count = readings_});
    else if (count < 512)
      add(Computation::readings, true, {Reason::sampled_model},
          {.kind = CostKind::direct_sum,
           .count = kernels,
           .rows = count,
           .columns = count,
           .operations = 2.0 * n * n * static_cast<double>(kernels)});
    else
      add(Computation::readings, true, {Reason::sampled_model},
          {.kind = CostKind::fft,
           .count = kernels,
           .operations = 20.0 * n * std::log2(4.0 * n) * static_cast<double>(kernels)});
  }

  void methods() {
    const std::size_t n = sizes_.tractions;
    const auto tractions = static_cast<double>(n);
    const double product = 2.0 * static_cast<double>(readings_) * tractions;
    add(Computation::dft, uses(Method::dft), named(Method::dft),
        {.kind = CostKind::frame_fft, .operations = 20.0 * tractions * std::log2(2.0 * tractions)});
    add(Computation::tikhonov, uses(Method::tikhonov), named(Method::tikhonov),
        sizes_.is_large ? Cost{CostKind::conjugate_gradients}
                        : Cost{.kind = CostKind::decompositions,
                               .rows = readings_ + n,
                               .columns = n,
                               .operations = product});
    add(Computation::closed_form, uses(Method::closed_form), named(Method::closed_form),
        {.kind = CostKind::product, .operations = product});
  }

  void rule_comparison() {
    const bool takes_alpha = with_matrix_ || uses(Method::network);
    const bool rule = takes_alpha && !options_.alpha;
    Why why{!takes_alpha             ? Reason::no_method_takes_alpha
            : rule                   ? Reason::rules_judge
            : request_.compare_rules ? Reason::comparison_requested
                                     : Reason::alpha_given};
    if (rule) why.rule = options_.alpha_rule;
    add(Computation::rule_comparison, rule || (request_.compare_rules && takes_alpha), why,
        {.kind = CostKind::alpha_rules, .count = alpha_rules.size()});
  }

  void errors() {
    const std::size_t n = sizes_.tractions;
    const bool limits = sizes_.has_limits && uses(Method::tikhonov);
    add(Computation::constraints, limits,
        {limits              ? Reason::limits_stated
         : sizes_.has_limits ? Reason::limits_of_tikhonov
                             : Reason::no_limits},
        {.kind = CostKind::active_set, .rows = readings_ + n, .columns = n});
    const bool bands = with_matrix_ && (!sizes_.is_large || !sizes_.has_limits);
    const bool dense = with_matrix_ && !sizes_.is_large;
    const auto why = [&](bool done, Reason reason) -> Why {
      return {done ? reason : !with_matrix_ ? Reason::no_matrix_method : Reason::array_too_large};
    };
    add(Computation::bands, bands, why(bands, Reason::forces_have_deviations),
        sizes_.is_large ? Cost{CostKind::conjugate_gradients}
                        : Cost{.kind = CostKind::inverse, .rows = n, .columns = n});
    add(Computation::hidden_modes, dense, why(dense, Reason::hidden_must_be_said),
        {.kind = CostKind::singular_values, .rows = readings_, .columns = n});
    add(Computation::data_verdict, dense && sizes_.knows_noise,
        why(dense, sizes_.knows_noise ? Reason::noise_stated : Reason::no_noise),
        {CostKind::contact_search});
  }

  void circuit() {
    const NetworkOptions& network = scene_.network;
    const bool on = uses(Method::network);
    const std::size_t n = on ? sizes_.unknowns * surface(of_circuit(scene_)).count : 0;
    add(Computation::circuit, on, {on ? Reason::method_named : Reason::no_circuit},
        {.kind = CostKind::circuit,
         .count = n * (n + 1) / 2,
         .rows = n,
         .realization = network.realization});
    const auto part = [&](Computation what, bool asked, Reason by, Reason without,
                          const Cost& cost) {
      add(what, on && asked, {!on ? Reason::no_circuit : asked ? by : without}, cost);
    };
    part(Computation::certificate, calls_for_certificate(network), Reason::parts_not_ideal,
         Reason::parts_ideal, {CostKind::certificate});
    part(Computation::transient, network.settling_accuracy.has_value(), Reason::settling_requested,
         Reason::settling_not_requested, {CostKind::transient});
    part(Computation::tolerance, calls_for_tolerance(network), Reason::tolerance_requested,
         network.tolerance ? Reason::tolerance_unsupported : Reason::nominal_parts,
         {.kind = CostKind::draws, .count = network.tolerance ? network.tolerance->trials : 0});
  }

  void time_course() {
    const bool one = !scene_.time || scene_.time->frames == 1;
    add(Computation::time_course, request_.report && !one && with_matrix_,
        {one                ? Reason::one_frame
         : !request_.report ? Reason::no_report
         : !with_matrix_    ? Reason::no_matrix_method
                            : Reason::resultant_drawn},
        {CostKind::every_frame});
  }

  const Scene& scene_;
  const ReconstructOptions& options_;
  bool with_matrix_;  // a method that forms K
};

class SkinCounter : Counter {
 public:
  SkinCounter(const SkinScene& scene, const WorkloadRequest& request)
      : Counter(request, sizes_of(scene), scene), scene_(scene) {}

  Workload work() {
    const bool exact = scene_.forward == ForwardModel::exact;
    const bool large = sizes_.is_large;
    const std::size_t n = sizes_.tractions;
    effects(scene_);
    add(Computation::readings, true, {exact ? Reason::exact_model : Reason::sampled_model},
        {.kind = exact ? CostKind::kernel_values : CostKind::sum, .count = exact ? readings_ : n});
    history(scene_);
    tangential(scene_);
    weights();
    add(Computation::tikhonov, true, {large ? Reason::matrix_too_large : Reason::matrix_held},
        large ? Cost{.kind = CostKind::tiles, .count = n}
              : Cost{.kind = CostKind::classes, .rows = readings_, .columns = n});
    add(Computation::alpha_rule, true,
        {.reason = scene_.reconstruct.alpha ? Reason::prior_by_rule : Reason::rule_chooses,
         .rule = scene_.reconstruct.alpha_rule},
        {large ? CostKind::probes : CostKind::one_rule});
    add(Computation::constraints, sizes_.has_limits,
        {sizes_.has_limits ? Reason::limits_stated : Reason::no_limits},
        {large ? CostKind::projected_gradients : CostKind::multipliers});
    add(Computation::bands, true, {Reason::forces_have_deviations},
        {large ? CostKind::solves : CostKind::class_sums});
    add(Computation::data_verdict, sizes_.knows_noise,
        {sizes_.knows_noise ? Reason::noise_stated : Reason::no_noise}, {CostKind::contact_search});
    report();
    return std::move(work_);
  }

 private:
  const SkinScene& scene_;
};

}  // namespace

std::string_view name(Computation computation) noexcept {
  return name_in<computations>(computation);
}

const Workload::Task* Workload::task(Computation computation) const noexcept {
  const auto found = std::find_if(tasks.begin(), tasks.end(),
                                  [=](const Task& one) { return one.what == computation; });
  return found != tasks.end() ? &*found : nullptr;
}

bool Workload::does(Computation computation) const noexcept {
  const Task* const found = task(computation);
  return found != nullptr && found->done;
}

Workload workload(const Scene& scene, const WorkloadRequest& request) {
  return LineCounter(scene, request).work();
}

Workload workload(const SkinScene& scene, const WorkloadRequest& request) {
  return SkinCounter(scene, request).work();
}

bool calls_for_certificate(const NetworkOptions& options) noexcept {
  return !options.parts.opamp.is_nullor() || options.parts.has_capacitance() || options.tolerance ||
         options.settling_accuracy;
}

bool calls_for_tolerance(const NetworkOptions& options) noexcept {
  return options.tolerance && traits(options.realization).linear();
}

}  // namespace tactile_net::lab
