#include "tactile_net/report/words/workload_words.hpp"

#include <ostream>

#include "report/json/scene_json.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {

void print_plan(std::ostream& out, const Scene& scene, const lab::ScenePlan& plan) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << '\n';
  if (scene.time) out << "  " << time_in_words(scene) << " (--frame takes another)\n";
  out << "\nEffects, in the order of the signal path:\n";
  std::vector<std::vector<std::string>> rows = {
      {"effect", "simulated", "operations a frame", "what it does"}};
  for (const lab::PlannedEffect& effect : plan.effects)
    rows.push_back({std::string(effect.name), effect.simulated ? "yes" : "no",
                    effect.operations > 0.0 ? brief(effect.operations) : "-", effect.words});
  print_cells(out, rows);
  out << "\nComputations:\n";
  rows = {{"computation", "done", "why", "what it takes"}};
  for (const lab::PlannedComputation& one : plan.computations)
    rows.push_back({std::string(name(one.what)), one.done ? "yes" : "no", one.why,
                    one.cost.empty() ? "-" : one.cost});
  print_cells(out, rows);
}

std::string plan_json(const Scene& scene, const lab::ScenePlan& plan) {
  Json json = scene_json(scene);
  Json effects = Json::array();
  for (const lab::PlannedEffect& effect : plan.effects)
    effects.push_back({{"effect", effect.name},
                       {"simulated", effect.simulated},
                       {"operations_per_frame", effect.operations},
                       {"text", effect.words}});
  Json computations = Json::array();
  for (const lab::PlannedComputation& one : plan.computations)
    computations.push_back({{"computation", name(one.what)},
                            {"done", one.done},
                            {"why", one.why},
                            {"cost", one.cost.empty() ? Json(nullptr) : Json(one.cost)}});
  json["plan"] = {{"effects", effects}, {"computations", computations}};
  return text_of(json);
}

}  // namespace tactile_net::report
