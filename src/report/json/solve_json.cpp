#include "tactile_net/report/json/solve_json.hpp"

#include <map>
#include <optional>
#include <variant>

#include "report/json/contact_json.hpp"
#include "report/json/data_json.hpp"
#include "report/json/document.hpp"
#include "report/json/finding_json.hpp"
#include "report/json/scene_json.hpp"
#include "report/shown_numbers.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {
namespace {

/// Stated; null where each frame has its own, and with one component, which nothing weighs.
std::optional<double> stated_weight(const Scene& scene) {
  return unknowns(scene) == 2 ? scene.reconstruct.tangential_weight : std::nullopt;
}
std::optional<double> stated_weight(const SkinScene& scene) {
  return components(scene) == 3 ? scene.reconstruct.tangential_weight : std::nullopt;
}

Json shown_json(const lab::RecordingOverview& overview) {
  Json list = Json::array();
  for (const lab::FrameGroup& group : overview.groups) {
    const lab::FrameAnswer& answer = group.answer;
    Json json = {{"frame", group.shown},           {"t", finite_or_null(group.time)},
                 {"first", group.first},           {"count", group.count},
                 {"distrusted", group.distrusted}, {"verdict", name(answer.verdict)},
                 {"doubted", group.doubted},       {"data", nullptr}};
    if (answer.data) json["data"] = doubts_json(*answer.data);
    const auto numbers = shown_numbers(overview, group);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      json[std::string(shown_names[i])] = number_or_null(numbers[i]);
    const auto contacts = overview.contacts(group);
    json["patches"] =
        overview.is_line() ? line_contacts_json(contacts) : skin_contacts_json(contacts);
    list.push_back(std::move(json));
  }
  return list;
}

/// Every frame of a skin.
Json rows_json(const lab::RecordingOverview& overview) {
  Json list = Json::array();
  for (const lab::FrameRow& row : overview.rows) {
    Json json = {{"t", finite_or_null(row.time)},
                 {"verdict", name(row.verdict)},
                 {"missing", row.missing     ? Json("skipped")
                             : row.estimated ? Json("estimated")
                                             : Json(nullptr)},
                 {"alpha", nullptr},
                 {"alpha_rule", nullptr},
                 {"tangential_weight", nullptr},
                 {"resultant", nullptr},
                 {"friction", uncertain_or_null(row.friction)},
                 {"patches", skin_contacts_json(row.contacts)},
                 {"data", nullptr}};
    if (!row.missing) {
      json["data"] = doubts_json(row.data);
      json["alpha"] = row.alpha.value;
      json["alpha_rule"] = source(row.alpha);
      json["tangential_weight"] = skin_weight_json(overview.skin(), row.alpha);
      json["resultant"] = found_json(row.wrench);
    }
    list.push_back(std::move(json));
  }
  return list;
}

/// The frame that presses hardest.
Json hardest_json(const lab::RecordingOverview& overview) {
  if (overview.groups.empty()) return nullptr;
  return overview.is_line() ? overview.peak().shown : overview.hardest;
}

}  // namespace

std::string solve_json(const lab::RecordingOverview& overview, const lab::SolvedFrames& solved,
                       const SolveReport& report) {
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
  const lab::ChosenAlpha& alpha = solved.last.alpha;
  const bool has_alpha = alpha.value > 0.0;
  const std::optional<lab::Condition>& condition = solved.last.condition;
  Json json = document(kind::solve);
  json.update(Json{
      {"scene", std::visit([](const auto& scene) { return scene.file; }, overview.scene)},
      {"readings", report.readings},
      {"frames", solved.frames},
      {"method", name(overview.method)},
      {"alpha", has_alpha && !alpha.rule ? Json(alpha.value) : Json(nullptr)},
      {"alpha_rule", has_alpha ? Json(source(alpha)) : Json(nullptr)},
      {"alpha_least", solved.least_alpha > 0.0 ? Json(solved.least_alpha) : Json(nullptr)},
      {"alpha_largest", solved.largest_alpha > 0.0 ? Json(solved.largest_alpha) : Json(nullptr)},
      {"tangential_weight",
       number_or_null(
           std::visit([](const auto& scene) { return stated_weight(scene); }, overview.scene))},
      {"tangential_weight_least", number_or_null(solved.least_weight)},
      {"tangential_weight_largest", number_or_null(solved.largest_weight)},
      {"offset",
       std::visit([](const auto& scene) { return scene.reconstruct.offset; }, overview.scene)},
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
      {"findings", findings_json(overview.findings, overview.scene)},
      {"events", events_json(overview.tracker.events())},
      {"grid", overview.is_line() ? Json(nullptr) : skin_grid_json(overview.grid)},
      {"hardest", hardest_json(overview)},
      {"shown", shown_json(overview)},
      {"rows", rows_json(overview)}});
  const std::optional<Units>& units = std::visit(
      [](const auto& scene) -> const std::optional<Units>& { return scene.units; }, overview.scene);
  if (units) json["units"] = overview.is_line() ? units_json(*units) : skin_units_json(*units);
  return text_of(json, 2);
}

}  // namespace tactile_net::report
