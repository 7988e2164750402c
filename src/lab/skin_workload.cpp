#include "tactile_net/lab/skin_workload.hpp"

#include "numeric/named.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/scene/skin_size.hpp"

namespace tactile_net::lab {
namespace {

using Computation = SkinWorkload::Computation;
using Reason = SkinWorkload::Reason;
using Cost = SkinWorkload::Cost;

constexpr Named<Computation> computations[] = {
    {Computation::readings, "readings"},         {Computation::history, "history"},
    {Computation::tangential, "tangential"},     {Computation::weights, "weights"},
    {Computation::tikhonov, "tikhonov"},         {Computation::alpha_rule, "alpha_rule"},
    {Computation::constraints, "constraints"},   {Computation::bands, "bands"},
    {Computation::data_verdict, "data_verdict"}, {Computation::report, "report"}};

}  // namespace

std::string_view name(Computation computation) noexcept {
  return name_in<computations>(computation);
}

SkinWorkload workload(const SkinScene& scene, bool report) {
  const SkinSceneProblem problem(scene);  // which makes nothing before it is asked
  const SkinReconstructOptions& options = scene.reconstruct;
  const std::size_t readings = reading_count(scene.sensor);
  const std::size_t cells = grid(scene).count();
  const std::size_t tractions = components(scene) * cells;
  const bool large = is_large(scene);
  const bool exact = scene.forward == ForwardModel::exact;
  const bool drags = components(scene) == 3;
  const bool weights = problem.estimates_weight();
  const bool limits = problem.constraints().has_value();
  const bool noise = problem.stated_noise().has_value();

  SkinWorkload work;
  for (const SceneEffect& effect : scene_effects())
    if (effect.present(scene)) work.effects.push_back(&effect);
  const auto add = [&](Computation what, bool done, Reason why, Cost cost, std::size_t count = 0) {
    work.tasks.push_back({.what = what,
                          .done = done,
                          .why = why,
                          .cost = done ? std::optional(cost) : std::nullopt,
                          .count = done ? count : 0});
  };
  add(Computation::readings, true, exact ? Reason::exact_model : Reason::sampled_model,
      exact ? Cost::kernel_values : Cost::sum, exact ? readings : tractions);
  add(Computation::history, scene.frame > 0,
      !scene.time        ? Reason::no_time
      : scene.frame == 0 ? Reason::first_frame
                         : Reason::frames_before,
      Cost::moments, instants(scene).size());
  add(Computation::tangential, drags,
      drags                              ? Reason::three_tractions
      : channel_count(scene.sensor) == 1 ? Reason::one_channel
      : options.tangential               ? Reason::tangential_excluded
                                         : Reason::no_drag,
      Cost::unknowns, tractions);
  add(Computation::weights, weights,
      !drags    ? Reason::one_traction
      : weights ? Reason::weight_unknown
                : Reason::weight_given,
      Cost::families);
  add(Computation::tikhonov, true, large ? Reason::matrix_too_large : Reason::matrix_held,
      large ? Cost::tiles : Cost::classes, tractions);
  work.tasks.back().rows = readings;
  add(Computation::alpha_rule, true, options.alpha ? Reason::prior_by_rule : Reason::rule_chooses,
      large ? Cost::probes : Cost::one_rule);
  work.tasks.back().rule = problem.alpha_rule();
  add(Computation::constraints, limits, limits ? Reason::limits_stated : Reason::no_limits,
      large ? Cost::projected_gradients : Cost::multipliers);
  add(Computation::bands, true, Reason::forces_have_deviations,
      large ? Cost::solves : Cost::class_sums);
  add(Computation::data_verdict, noise, noise ? Reason::noise_stated : Reason::no_noise,
      Cost::contact_search);
  add(Computation::report, report, report ? Reason::report_requested : Reason::no_report,
      Cost::drawing);
  return work;
}

}  // namespace tactile_net::lab
