#include "tactile_net/report/json/solve_json.hpp"

#include <map>

#include "report/json/document.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {

std::string solve_json(const Scene& scene, const lab::SolvedFrames& solved,
                       const SolveReport& report) {
  std::map<std::string, std::size_t> verdicts;  // sorted by name
  for (const auto& [verdict, count] : solved.verdicts) verdicts.emplace(lab::name(verdict), count);
  Json distrusted = Json::object();
  for (const auto& [verdict, frames] : solved.distrusted)
    distrusted[std::string(lab::name(verdict))] = runs_json(frames);
  const std::string verdict = verdicts.size() == 1 ? verdicts.begin()->first : "mixed";
  const std::optional<lab::ChosenAlpha>& alpha = solved.last.alpha;
  const std::optional<lab::Condition>& condition = solved.last.condition;
  Json json = document(kind::solve);
  json.update(Json{
      {"scene", scene.file},
      {"readings", report.readings},
      {"frames", solved.frames},
      {"method", name(report.method)},
      {"alpha", alpha && !alpha->rule ? Json(alpha->value) : Json(nullptr)},
      {"alpha_rule", alpha ? Json(source(*alpha)) : Json(nullptr)},
      {"alpha_least", solved.least_alpha > 0.0 ? Json(solved.least_alpha) : Json(nullptr)},
      {"alpha_largest", solved.largest_alpha > 0.0 ? Json(solved.largest_alpha) : Json(nullptr)},
      {"verdict", verdict},
      {"verdicts", verdicts},
      {"distrusted", distrusted},
      {"missing",
       {{"policy", lab::name(report.missing)},
        {"skipped", runs_json(solved.skipped)},
        {"estimated", runs_json(solved.estimated)}}},
      {"condition", condition ? Json(condition->value) : Json(nullptr)},
      {"condition_kind", condition ? Json(name(condition->kind)) : Json(nullptr)},
      {"condition_of", condition ? Json(name(condition->matrix)) : Json(nullptr)},
      {"warnings", in_words(report.remarks)},
      {"columns_ignored", report.columns_ignored},
      {"seconds", report.seconds}});
  if (scene.units) json["units"] = units_json(*scene.units);
  return text_of(json, 2);
}

}  // namespace tactile_net::report
