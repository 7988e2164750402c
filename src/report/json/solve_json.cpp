#include "tactile_net/report/json/solve_json.hpp"

#include <map>

#include "report/json/contact_json.hpp"
#include "report/json/data_json.hpp"
#include "report/json/document.hpp"
#include "report/json/finding_json.hpp"
#include "report/json/scene_json.hpp"
#include "report/shown_numbers.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {
namespace {

Json shown_json(const lab::RecordingOverview& overview) {
  Json list = Json::array();
  for (const lab::FrameGroup& group : overview.groups) {
    Json json = {{"frame", group.shown},           {"t", finite_or_null(group.time)},
                 {"first", group.first},           {"count", group.count},
                 {"distrusted", group.distrusted}, {"verdict", name(group.verdict)},
                 {"doubted", group.doubted},       {"data", nullptr}};
    if (group.data) json["data"] = doubts_json(*group.data);
    const auto numbers = shown_numbers(overview, group);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      json[std::string(shown_names[i])] = number_or_null(numbers[i]);
    json["patches"] = line_contacts_json(group.contacts);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

std::string solve_json(const lab::RecordingOverview& overview, const lab::SolvedFrames& solved,
                       const SolveReport& report) {
  const Scene& scene = overview.scene;
  std::map<std::string, std::size_t> verdicts;  // sorted by name
  for (const auto& [verdict, count] : solved.verdicts) verdicts.emplace(lab::name(verdict), count);
  Json distrusted = Json::object();
  for (const auto& [verdict, frames] : solved.distrusted)
    distrusted[std::string(lab::name(verdict))] = as_json(frames);
  Json doubted = Json::object();
  for (const auto& [doubt, frames] : solved.doubted)
    doubted[std::string(name(doubt))] = as_json(frames);
  Json bad_taxels = Json::array();
  for (const auto& [taxel, frames] : solved.bad_taxels)
    bad_taxels.push_back({{"taxel", taxel}, {"frames", frames}});
  const std::string verdict = verdicts.size() == 1 ? verdicts.begin()->first : "mixed";
  const std::optional<lab::ChosenAlpha>& alpha = solved.last.alpha;
  const std::optional<lab::Condition>& condition = solved.last.condition;
  Json json = document(kind::solve);
  json.update(Json{
      {"scene", scene.file},
      {"readings", report.readings},
      {"frames", solved.frames},
      {"method", name(overview.method)},
      {"alpha", alpha && !alpha->rule ? Json(alpha->value) : Json(nullptr)},
      {"alpha_rule", alpha ? Json(source(*alpha)) : Json(nullptr)},
      {"alpha_least", solved.least_alpha > 0.0 ? Json(solved.least_alpha) : Json(nullptr)},
      {"alpha_largest", solved.largest_alpha > 0.0 ? Json(solved.largest_alpha) : Json(nullptr)},
      {"tangential_weight",
       unknowns(scene) == 2 ? number_or_null(scene.reconstruct.tangential_weight) : Json(nullptr)},
      {"tangential_weight_least", number_or_null(solved.least_weight)},
      {"tangential_weight_largest", number_or_null(solved.largest_weight)},
      {"offset", scene.reconstruct.offset},
      {"verdict", verdict},
      {"verdicts", verdicts},
      {"distrusted", distrusted},
      {"data",
       {{"noise_known", solved.noise_known}, {"doubted", doubted}, {"bad_taxels", bad_taxels}}},
      {"missing",
       {{"policy", lab::name(report.missing)},
        {"skipped", as_json(solved.skipped)},
        {"estimated", as_json(solved.estimated)}}},
      {"condition", condition ? Json(condition->value) : Json(nullptr)},
      {"condition_kind", condition ? Json(name(condition->kind)) : Json(nullptr)},
      {"condition_of", condition ? Json(name(condition->matrix)) : Json(nullptr)},
      {"warnings", in_words(report.remarks)},
      {"columns_ignored", report.columns_ignored},
      {"seconds", report.seconds},
      {"findings", findings_json(overview.findings, scene)},
      {"events", events_json(overview.tracker.events())},
      {"shown", shown_json(overview)}});
  if (scene.units) json["units"] = units_json(*scene.units);
  return text_of(json, 2);
}

}  // namespace tactile_net::report
