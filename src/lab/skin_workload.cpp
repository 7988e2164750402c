#include "tactile_net/lab/skin_workload.hpp"

#include "numeric/named.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/scene/skin_size.hpp"

namespace tactile_net::lab {
namespace {

using SkinComputation = SkinWorkload::Computation;
using SkinReason = SkinWorkload::Reason;
using SkinCost = SkinWorkload::Cost;

constexpr Named<SkinComputation> skin_computations[] = {
    {SkinComputation::readings, "readings"},         {SkinComputation::history, "history"},
    {SkinComputation::tangential, "tangential"},     {SkinComputation::weights, "weights"},
    {SkinComputation::tikhonov, "tikhonov"},         {SkinComputation::alpha_rule, "alpha_rule"},
    {SkinComputation::constraints, "constraints"},   {SkinComputation::bands, "bands"},
    {SkinComputation::data_verdict, "data_verdict"}, {SkinComputation::report, "report"}};

}  // namespace

std::string_view name(SkinComputation computation) noexcept {
  return name_in<skin_computations>(computation);
}

SkinWorkload workload(const SkinScene& scene, bool report) {
  const SkinSceneProblem problem(scene);  // which makes nothing before it is asked
  const SkinReconstructOptions& options = scene.reconstruct;
  const std::size_t readings = reading_count(scene.sensor);
  const std::size_t cells = grid(scene).count();
  const std::size_t tractions = components(scene) * cells;
  const bool large_skin = is_large(scene);
  const bool exact = scene.forward == ForwardModel::exact;
  const bool drags = components(scene) == 3;
  const bool weights = problem.estimates_weight();
  const bool limits = problem.constraints().has_value();
  const bool noise = problem.stated_noise().has_value();

  SkinWorkload work;
  for (const SceneEffect& effect : scene_effects())
    if (effect.present(scene)) work.effects.push_back(&effect);
  const auto add = [&](SkinComputation what, bool done, SkinReason why, SkinCost cost,
                       std::size_t count = 0) {
    work.tasks.push_back({.what = what,
                          .done = done,
                          .why = why,
                          .cost = done ? std::optional(cost) : std::nullopt,
                          .count = done ? count : 0});
  };
  add(SkinComputation::readings, true, exact ? SkinReason::exact_model : SkinReason::sampled_model,
      exact ? SkinCost::kernel_values : SkinCost::sum, exact ? readings : tractions);
  add(SkinComputation::history, scene.frame > 0,
      !scene.time        ? SkinReason::no_time
      : scene.frame == 0 ? SkinReason::first_frame
                         : SkinReason::frames_before,
      SkinCost::moments, instants(scene).size());
  add(SkinComputation::tangential, drags,
      drags                              ? SkinReason::three_tractions
      : channel_count(scene.sensor) == 1 ? SkinReason::one_channel
      : options.tangential               ? SkinReason::tangential_excluded
                                         : SkinReason::no_drag,
      SkinCost::unknowns, tractions);
  add(SkinComputation::weights, weights,
      !drags    ? SkinReason::one_traction
      : weights ? SkinReason::weight_unknown
                : SkinReason::weight_given,
      SkinCost::families);
  add(SkinComputation::tikhonov, true,
      large_skin ? SkinReason::matrix_too_large : SkinReason::matrix_held,
      large_skin ? SkinCost::tiles : SkinCost::classes, tractions);
  work.tasks.back().rows = readings;
  add(SkinComputation::alpha_rule, true,
      options.alpha ? SkinReason::prior_by_rule : SkinReason::rule_chooses,
      large_skin ? SkinCost::probes : SkinCost::one_rule);
  work.tasks.back().rule = options.alpha_rule;
  add(SkinComputation::constraints, limits,
      limits ? SkinReason::limits_stated : SkinReason::no_limits,
      large_skin ? SkinCost::projected_gradients : SkinCost::multipliers);
  add(SkinComputation::bands, true, SkinReason::forces_have_deviations,
      large_skin ? SkinCost::solves : SkinCost::class_sums);
  add(SkinComputation::data_verdict, noise, noise ? SkinReason::noise_stated : SkinReason::no_noise,
      SkinCost::contact_search);
  add(SkinComputation::report, report,
      report ? SkinReason::report_requested : SkinReason::no_report, SkinCost::drawing);
  return work;
}

}  // namespace tactile_net::lab
