#include "tactile_net/report/json/workload_json.hpp"

#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/workload_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {
namespace {

struct EffectTold {
  std::string_view effect{};
  bool simulated = false;
  double operations_per_frame = 0.0;
  std::string text{};

  static constexpr auto described = std::tuple{
      field("effect", &EffectTold::effect, "Its name."),
      field("simulated", &EffectTold::simulated, "Whether the scene has it."),
      field("operations_per_frame", &EffectTold::operations_per_frame,
            "Floating-point operations; a random number counts as 20."),
      field("text", &EffectTold::text, "What it does in this scene, or what its absence saves.")};
};

struct ComputationTold {
  lab::Computation computation = lab::Computation::readings;
  bool done = false;
  lab::WorkloadReason reason = lab::WorkloadReason::exact_model;
  std::string why{};
  std::optional<lab::WorkloadCost> takes{};
  std::optional<std::string> cost{};

  static constexpr auto described = std::tuple{
      field("computation", &ComputationTold::computation, "Which it is."),
      field("done", &ComputationTold::done, "Whether it is done; false: it is left out."),
      field("reason", &ComputationTold::reason, "Why it is done or left out."),
      field("why", &ComputationTold::why, "The reason as a sentence with its numbers."),
      field("takes", &ComputationTold::takes, "What it takes; null: it is left out."),
      field("cost", &ComputationTold::cost, "The same as a sentence with its numbers.")};
};

struct WorkloadTold {
  std::vector<EffectTold> effects{};
  std::vector<ComputationTold> computations{};

  static constexpr auto described =
      std::tuple{field("effects", &WorkloadTold::effects, "In the order of the signal path."),
                 field("computations", &WorkloadTold::computations,
                       "Each that there is for this sensor, whether it is done or not.")};
};

struct ExplainTold : SceneFrameTold {
  WorkloadTold plan{};

  static constexpr auto described = std::tuple_cat(
      SceneFrameTold::described, std::tuple{field("plan", &ExplainTold::plan, "What `run` does.")});
};

std::string explain_json(const auto& scene, const lab::Workload& work) {
  ExplainTold told{scene_told(scene), {}};
  for (const lab::Workload::Effect& effect : work.effects)
    told.plan.effects.push_back({.effect = effect.row->name,
                                 .simulated = effect.simulated,
                                 .operations_per_frame = effect.operations,
                                 .text = effect_in_words(effect, scene)});
  for (const lab::Workload::Task& task : work.tasks) {
    ComputationTold& one =
        told.plan.computations.emplace_back(ComputationTold{.computation = task.what,
                                                            .done = task.done,
                                                            .reason = task.why.reason,
                                                            .why = why_in_words(task)});
    if (!task.cost) continue;
    one.takes = task.cost->kind;
    one.cost = cost_in_words(task);
  }
  return document_text(kind::explain, told);
}

}  // namespace

std::string workload_json(const Scene& scene, const lab::Workload& work) {
  return explain_json(scene, work);
}
std::string workload_json(const SkinScene& scene, const lab::Workload& work) {
  return explain_json(scene, work);
}

Json explain_schema() {
  return document_schema<ExplainTold>(kind::explain, "What `run` does of a scene, and why");
}

}  // namespace tactile_net::report
