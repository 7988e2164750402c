#include <cmath>

#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "report/load_dimension.hpp"
#include "report/recording_fields.hpp"

namespace tactile_net::report {
namespace {

struct ReportTold {
  std::string scene{};
  std::size_t fine = 0;
  std::size_t needs_a_look = 0;
  std::size_t no_answer = 0;
  std::vector<RecordingTold> recordings{};
  IfAny<UnitsTold> units{};

  static constexpr auto described = std::tuple{
      field("scene", &ReportTold::scene, "The scene's file."),
      field("fine", &ReportTold::fine, "How many recordings are fine."),
      field("needs_a_look", &ReportTold::needs_a_look, "How many somebody should look at."),
      field("no_answer", &ReportTold::no_answer, "How many could not be read or solved."),
      field("recordings", &ReportTold::recordings, "Each recording, the most suspicious first."),
      field("units", &ReportTold::units,
            "The units of these numbers; only of a scene with [units].")};
};

}  // namespace

std::string recordings_json(RecordingRows rows, const AnyScene& scene) {
  ReportTold all{.recordings = recordings_told(rows, scene)};
  for (const RecordingTold& one : all.recordings) {
    all.fine += one.standing == lab::Standing::fine ? 1 : 0;
    all.needs_a_look += one.standing == lab::Standing::needs_a_look ? 1 : 0;
    all.no_answer += one.standing == lab::Standing::no_answer ? 1 : 0;
  }
  std::visit(
      [&](const auto& one) {
        all.scene = one.file;
        all.units = units_told(one.units, load_dimension(one));
      },
      scene);
  return document_text(kind::report, all);
}

std::vector<std::string> linked_pages(std::string_view json) {
  std::vector<std::string> pages;
  const Json all = Json::parse(json, nullptr, false);
  if (!all.is_object() || all.value("kind", "") != kind::report.name) return pages;
  for (const Json& row : all.value("recordings", Json::array()))
    if (row.is_object() && row.contains("page") && row["page"].is_string())
      pages.push_back(row["page"]);
  return pages;
}

std::string recording_keys_json(RecordingRows rows, const AnyScene& scene) {
  Json all = Json::array();
  for (const lab::RecordingRow& row : rows) {
    const auto number = [&](double value) {
      return row.problem.empty() ? finite_or_null(value) : Json(nullptr);
    };
    all.push_back({row.name, static_cast<int>(row.standing()), number(row.share_faultless()),
                   number(static_cast<double>(row.findings.size())),
                   number(row.force ? row.force->value : std::nan("")),
                   row.force_time ? Json(*row.force_time)
                                  : number(row.force_frame ? static_cast<double>(*row.force_frame)
                                                           : std::nan("")),
                   number_or_null(row.slip_margin), number_or_null(row.duration),
                   worst_in_words(row, scene)});
  }
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json recordings_schema() {
  return document_schema<ReportTold>(kind::report, "What `report` found in many recordings");
}

}  // namespace tactile_net::report
