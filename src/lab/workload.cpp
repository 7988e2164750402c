#include "tactile_net/lab/workload.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/named.hpp"
#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {
namespace {

using Reason = Workload::Reason;
using Why = Workload::Why;
using Cost = Workload::Cost;
using CostKind = Workload::Cost::Kind;

/// Sizes that costs are made of.
struct Sizes {
  explicit Sizes(const Scene& scene)
      : taxels(scene.sensor.count),
        channels(channel_count(scene.sensor)),
        readings(reading_count(scene.sensor)),
        unknowns(tactile_net::unknowns(scene)),
        values(surface(scene).count),
        tractions(values * unknowns),
        kernels(channels * (any_friction(scene) ? 2 : 1)),
        frames(scene.frame + 1),
        moments(instants(scene).size()),
        is_large(lab::is_large(scene, tractions)) {}
  std::size_t taxels, channels, readings, unknowns, values, tractions, kernels, frames, moments;
  bool is_large;
};

class Counter {
 public:
  Counter(const Scene& scene, const WorkloadRequest& request)
      : scene_(scene),
        options_(scene.reconstruct),
        request_(request),
        sizes_(scene),
        with_matrix_(uses(Method::tikhonov) || uses(Method::closed_form)) {}

  Workload work() {
    for (const SceneEffect& effect : scene_effects()) add_effect(effect);
    readings();
    history();
    unknowns();
    methods();
    rule_comparison();
    errors();
    circuit();
    time_course();
    add(Computation::report, request_.report,
        {request_.report ? Reason::report_requested : Reason::no_report}, {CostKind::drawing});
    return std::move(work_);
  }

 private:
  void add(Computation what, bool done, const Why& why, const Cost& cost) {
    work_.tasks.push_back({what, done, why, done ? std::optional(cost) : std::nullopt});
  }

  [[nodiscard]] bool uses(Method method) const {
    return std::find(options_.methods.begin(), options_.methods.end(), method) !=
           options_.methods.end();
  }

  void add_effect(const SceneEffect& effect) {
    Workload::Effect work{.row = &effect, .simulated = effect.present(scene_)};
    if (work.simulated) {
      work.idle = effect.make != nullptr && effect.make(scene_, scene_.sensor) == nullptr;
      if (!work.idle)
        work.operations = effect.operations(scene_) * static_cast<double>(sizes_.readings);
    }
    work_.effects.push_back(work);
  }

  void readings() {
    const std::size_t count = sizes_.taxels;
    const auto n = static_cast<double>(count);
    const auto kernels = static_cast<double>(sizes_.kernels);
    if (scene_.forward == ForwardModel::exact)
      add(Computation::readings, true, {Reason::exact_model},
          {.kind = CostKind::kernel_values, .count = sizes_.readings});
    else if (count < 512)
      add(Computation::readings, true, {Reason::sampled_model},
          {.kind = CostKind::direct_sum,
           .count = sizes_.kernels,
           .rows = count,
           .columns = count,
           .operations = 2.0 * n * n * kernels});
    else
      add(Computation::readings, true, {Reason::sampled_model},
          {.kind = CostKind::fft,
           .count = sizes_.kernels,
           .operations = 20.0 * n * std::log2(4.0 * n) * kernels});
  }

  void history() {
    const bool history = sizes_.frames > 1;
    const bool memory = sizes_.moments > sizes_.frames || signal_path(scene_).has_memory();
    Why why{!scene_.time ? Reason::no_time
            : !history   ? Reason::first_frame
            : memory     ? Reason::effects_remember
                         : Reason::only_draws_matter};
    if (why.reason == Reason::effects_remember) why.frame = scene_.frame;
    add(Computation::history, history, why,
        memory ? Cost{.kind = CostKind::moments, .count = sizes_.moments}
               : Cost{CostKind::random_draws});
  }

  void unknowns() {
    const bool two = sizes_.unknowns == 2;
    add(Computation::tangential, two,
        {two                    ? Reason::two_tractions
         : sizes_.channels == 1 ? Reason::one_channel
         : options_.tangential  ? Reason::tangential_excluded
                                : Reason::no_friction},
        {.kind = CostKind::unknowns, .count = sizes_.tractions, .rows = sizes_.values});
    const bool layer = scene_.material.layer.has_value();
    add(Computation::layer_kernels, layer, {layer ? Reason::layer : Reason::half_plane},
        {.kind = CostKind::kernel_integrals, .count = 2 * sizes_.values - 1});
  }

  void methods() {
    const std::size_t m = sizes_.readings;
    const std::size_t n = sizes_.tractions;
    const auto tractions = static_cast<double>(n);
    const double product = 2.0 * static_cast<double>(m) * tractions;
    add(Computation::dft, uses(Method::dft), named(Method::dft),
        {.kind = CostKind::frame_fft, .operations = 20.0 * tractions * std::log2(2.0 * tractions)});
    add(Computation::tikhonov, uses(Method::tikhonov), named(Method::tikhonov),
        sizes_.is_large ? Cost{CostKind::conjugate_gradients}
                        : Cost{.kind = CostKind::decompositions,
                               .rows = m + n,
                               .columns = n,
                               .operations = product});
    add(Computation::closed_form, uses(Method::closed_form), named(Method::closed_form),
        {.kind = CostKind::product, .operations = product});
  }

  void rule_comparison() {
    const bool takes_alpha = with_matrix_ || uses(Method::network);
    const bool rule = takes_alpha && !options_.alpha;
    Why why{!takes_alpha             ? Reason::no_method_takes_alpha
            : rule                   ? Reason::rule_chooses
            : request_.compare_rules ? Reason::comparison_requested
                                     : Reason::alpha_given};
    if (rule) why.rule = options_.alpha_rule;
    add(Computation::rule_comparison, rule || (request_.compare_rules && takes_alpha), why,
        {.kind = CostKind::alpha_rules, .count = alpha_rules.size()});
  }

  [[nodiscard]] Why named(Method method) const {
    return {uses(method) ? Reason::method_named : Reason::method_not_named};
  }

  void errors() {
    const std::size_t n = sizes_.tractions;
    const bool constrained = options_.nonnegative || options_.friction_limit;
    const bool bands = with_matrix_ && (!sizes_.is_large || !constrained);
    const bool hidden = with_matrix_ && !sizes_.is_large;
    const auto why = [&](bool done, Reason reason) -> Why {
      return {done ? reason : !with_matrix_ ? Reason::no_matrix_method : Reason::array_too_large};
    };
    add(Computation::bands, bands, why(bands, Reason::forces_have_deviations),
        sizes_.is_large ? Cost{CostKind::conjugate_gradients}
                        : Cost{.kind = CostKind::inverse, .rows = n, .columns = n});
    add(Computation::hidden_modes, hidden, why(hidden, Reason::hidden_must_be_said),
        {.kind = CostKind::singular_values, .rows = sizes_.readings, .columns = n});
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
  const WorkloadRequest& request_;
  Sizes sizes_;
  bool with_matrix_;  // a method that forms K
  Workload work_;
};

constexpr Named<Computation> computations[] = {{Computation::readings, "readings"},
                                               {Computation::history, "history"},
                                               {Computation::tangential, "tangential"},
                                               {Computation::layer_kernels, "layer_kernels"},
                                               {Computation::dft, "dft"},
                                               {Computation::tikhonov, "tikhonov"},
                                               {Computation::closed_form, "closed_form"},
                                               {Computation::rule_comparison, "rule_comparison"},
                                               {Computation::bands, "bands"},
                                               {Computation::hidden_modes, "hidden_modes"},
                                               {Computation::circuit, "circuit"},
                                               {Computation::certificate, "certificate"},
                                               {Computation::transient, "transient"},
                                               {Computation::tolerance, "tolerance"},
                                               {Computation::time_course, "time_course"},
                                               {Computation::report, "report"}};

}  // namespace

std::string_view name(Computation computation) noexcept {
  return name_in<computations>(computation);
}

bool Workload::does(Computation computation) const noexcept {
  return std::any_of(tasks.begin(), tasks.end(),
                     [=](const auto& one) { return one.what == computation && one.done; });
}

Workload workload(const Scene& scene, const WorkloadRequest& request) {
  return Counter(scene, request).work();
}

bool calls_for_certificate(const NetworkOptions& options) noexcept {
  return !options.parts.opamp.is_nullor() || options.parts.node_capacitance || options.tolerance ||
         options.settling_accuracy;
}

bool calls_for_tolerance(const NetworkOptions& options) noexcept {
  return options.tolerance && traits(options.realization).linear();
}

}  // namespace tactile_net::lab
