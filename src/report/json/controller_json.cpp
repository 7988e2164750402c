#include "tactile_net/report/json/controller_json.hpp"

#include "report/json/document.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/controller_words.hpp"

namespace tactile_net::report {
namespace {

std::string document_of(const std::string& file, const std::optional<Units>& units,
                        const lab::PlannedController& planned, double frame_seconds) {
  Json candidates = Json::array();
  for (const Candidate& candidate : planned.estimator.candidates)
    candidates.push_back({{"structure", name(candidate.structure)},
                          {"precision", name(candidate.precision)},
                          {"ranks", candidate.ranks},
                          {"exchanged", candidate.exchanged},
                          {"transform_size", candidate.transform_size},
                          {"bytes", candidate.bytes},
                          {"error_bound", candidate.error_bound},
                          {"accurate", candidate.accurate},
                          {"chosen", candidate.chosen}});
  const EstimatorPlan& plan = planned.estimator.plan;
  Json json = document(kind::plan);
  json.update(Json{{"scene", file},
                   {"readings", plan.readings()},
                   {"tractions", plan.tractions()},
                   {"alpha", plan.alpha},
                   {"alpha_rule", in_words(planned.alpha)},
                   {"accuracy", plan.accuracy},
                   {"error_bound", plan.error_bound},
                   {"asymmetry", planned.estimator.asymmetry},
                   {"frame_seconds", frame_seconds},
                   {"candidates", std::move(candidates)}});
  json["force"] = planned.force
                      ? Json{{"planned", planned.force->planned}, {"solved", planned.force->solved}}
                      : Json(nullptr);
  if (plan.cells || plan.fill) json["filled_readings"] = plan.fill ? plan.fill->rows : 0;
  if (units) json["units"] = units_json(*units);
  if (planned.for_raw_numbers) json["baseline"] = plan.baseline;  // empty: 0
  return text_of(json, 2);
}

}  // namespace

std::string controller_json(const Scene& scene, const lab::PlannedController& planned,
                            double frame_seconds) {
  return document_of(scene.file, scene.units, planned, frame_seconds);
}

std::string controller_json(const SkinScene& scene, const lab::PlannedController& planned,
                            double frame_seconds) {
  return document_of(scene.file, scene.units, planned, frame_seconds);
}

}  // namespace tactile_net::report
