#include "tactile_net/report/json/sweep_json.hpp"

#include "report/json/document.hpp"
#include "tactile_net/sweep/summary.hpp"

namespace tactile_net::report {
namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// What it did not mean to measure is not there: null.
Json group_json(const sweep::Group& group) {
  return {{"rows", group.rows},
          {"ok", group.trusted},
          {"failed", group.failed},
          {"median_error", number_or_null(group.median_error)},
          {"largest_error", number_or_null(group.largest_error)},
          {"median_alpha", number_or_null(group.median_alpha)}};
}

Json values_json(const std::vector<sweep::Part>& parts) {
  Json list = Json::array();
  for (const sweep::Part& part : parts) {
    Json json = {{"value", part.value}};
    json.update(group_json(sweep::group(part.rows)));
    list.push_back(std::move(json));
  }
  return list;
}

Json json_of_method(const sweep::Table& table, const std::string& method) {
  const std::vector<const sweep::Row*> rows = sweep::of_method(table, method);
  Json axes = Json::array();
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    if (const auto parts = sweep::by_value(rows, axis); sweep::can_be_listed(table, axis, parts))
      axes.push_back({{"key", table.axes[axis]}, {"values", values_json(parts)}});
  Json json = {{"method", text_or_null(method)}};
  json.update(group_json(sweep::group(rows)));
  json["axes"] = std::move(axes);
  return json;
}

}  // namespace

std::string sweep_json(const sweep::Table& table, std::optional<std::size_t> resumed) {
  Json axes = Json::array();
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    axes.push_back({{"key", table.axes[axis]}, {"unit", text_or_null(table.units.axes[axis])}});
  Json keep = Json::array();
  for (const Kept kept : table.keep) keep.push_back(name(kept));
  Json methods = Json::array();
  for (const std::string& method : sweep::methods(table))
    methods.push_back(json_of_method(table, method));
  if (!sweep::of_method(table, "").empty()) methods.push_back(json_of_method(table, ""));
  Json failures = Json::array();
  for (const auto& [why, rows] : sweep::failures(table))
    failures.push_back({{"why", why}, {"rows", rows}});
  const std::string& force = table.units.force;
  Json json = document(kind::sweep);
  json.update(Json{
      {"title", table.title},
      {"study_sha256", table.study},
      {"axes", std::move(axes)},
      {"keep", std::move(keep)},
      {"points", table.points},
      {"points_failed", sweep::failed_points(table)},
      {"points_resumed", resumed ? Json(*resumed) : Json(nullptr)},
      {"units",
       force.empty() ? Json(nullptr) : Json{{"length", "m"}, {"stress", "Pa"}, {"force", force}}},
      {"results", {{"file", "results.csv"}, {"rows", table.rows.size()}, {"sha256", table.sha256}}},
      {"methods", std::move(methods)},
      {"failures", std::move(failures)}});
  return text_of(json);
}

}  // namespace tactile_net::report
