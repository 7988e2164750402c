#include "tactile_net/report/json/sweep_json.hpp"

#include "report/json/described.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/sweep/summary.hpp"

namespace tactile_net {

/// What it did not mean to measure is not there: null.
template <>
struct Fields<sweep::Group> {
  static constexpr auto all =
      std::tuple{field("rows", &sweep::Group::rows, "How many rows there are."),
                 field("ok", &sweep::Group::trusted, "How many have the verdict ok."),
                 field("failed", &sweep::Group::failed, "How many have no answer."),
                 field("median_error", &sweep::Group::median_error,
                       "The median of their relative errors; null: no row has one."),
                 field("largest_error", &sweep::Group::largest_error,
                       "The largest of their relative errors; null: no row has one."),
                 field("median_alpha", &sweep::Group::median_alpha,
                       "The median of their alphas; null: no row has one.")};
};

namespace report {
namespace {

std::optional<std::string> if_said(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

struct AxisTold {
  std::string key{};
  std::optional<std::string> unit{};

  static constexpr auto described = std::tuple{
      field("key", &AxisTold::key, "The scene's key that changes."),
      field("unit", &AxisTold::unit,
            "The unit of its values, as the scene's [units] states it; null: none, or not "
            "stated.")};
};

struct ValueTold : sweep::Group {
  std::string value{};

  static constexpr auto described = std::tuple_cat(
      std::tuple{field("value", &ValueTold::value, "The value, as it stands in the study.")},
      Fields<sweep::Group>::all);
};

struct ValuesTold {
  std::string key{};
  std::vector<ValueTold> values{};

  static constexpr auto described =
      std::tuple{field("key", &ValuesTold::key, "The scene's key that changes."),
                 field("values", &ValuesTold::values, "The rows with each of its values.")};
};

struct MethodTold : sweep::Group {
  std::optional<Method> method{};
  std::vector<ValuesTold> axes{};

  static constexpr auto described = std::tuple_cat(
      std::tuple{
          field("method", &MethodTold::method, "The method; null: points that failed before any.")},
      Fields<sweep::Group>::all,
      std::tuple{field("axes", &MethodTold::axes,
                       "What each axis does, whatever the others have; without repeats, and axes "
                       "of more than 40 values.")});
};

struct SweepUnitsTold {
  std::string_view length = "m";
  std::string_view stress = "Pa";
  std::string force{};

  static constexpr auto described =
      std::tuple{field("length", &SweepUnitsTold::length, "Of lengths."),
                 field("stress", &SweepUnitsTold::stress, "Of stresses, tractions and moduli."),
                 field("force", &SweepUnitsTold::force, "Of loads.")};
};

struct ResultsTold {
  std::string_view file = "results.csv";
  std::size_t rows = 0;
  std::string sha256{};

  static constexpr auto described =
      std::tuple{field("file", &ResultsTold::file, "The file's name."),
                 field("rows", &ResultsTold::rows, "How many rows it has."),
                 field("sha256", &ResultsTold::sha256, "The SHA-256 of its bytes.")};
};

struct FailureTold {
  std::string why{};
  std::size_t rows = 0;

  static constexpr auto described =
      std::tuple{field("why", &FailureTold::why, "Why there is no answer."),
                 field("rows", &FailureTold::rows, "How many rows say so.")};
};

struct SweepTold {
  std::string title{};
  std::string study{};
  std::vector<AxisTold> axes{};
  std::vector<Kept> keep{};
  std::size_t points = 0;
  std::size_t points_failed = 0;
  std::optional<std::size_t> points_resumed{};
  std::optional<SweepUnitsTold> units{};
  ResultsTold results{};
  std::vector<MethodTold> methods{};
  std::vector<FailureTold> failures{};

  static constexpr auto described = std::tuple{
      field("title", &SweepTold::title, "The study's title; its file's name where it has none."),
      field("study_sha256", &SweepTold::study, "The SHA-256 of all that the rows depend on."),
      field("axes", &SweepTold::axes,
            "What changes, in the study's order; repeat is the last where points are repeated."),
      field("keep", &SweepTold::keep, "The columns of the rows beside those that all have."),
      field("points", &SweepTold::points, "How many points the study has."),
      field("points_failed", &SweepTold::points_failed, "Points of which no row has an answer."),
      field("points_resumed", &SweepTold::points_resumed,
            "Points that an earlier call had done; null: not known, as of merge."),
      field("units", &SweepTold::units, "The answers' units; null: the scene states none."),
      field("results", &SweepTold::results,
            "The file of all rows, which merge writes into its folder."),
      field("methods", &SweepTold::methods, "What the rows of each method come to."),
      field("failures", &SweepTold::failures,
            "Why points or methods have no answer, the most frequent reason first.")};
};

MethodTold method_told(const sweep::Table& table, const std::string& method) {
  const std::vector<const sweep::Row*> rows = sweep::of_method(table, method);
  MethodTold told{sweep::group(rows), method_named(method)};
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis) {
    const std::vector<sweep::Part> parts = sweep::by_value(rows, axis);
    if (!sweep::can_be_listed(table, axis, parts)) continue;
    ValuesTold& one = told.axes.emplace_back(ValuesTold{table.axes[axis]});
    for (const sweep::Part& part : parts)
      one.values.push_back({sweep::group(part.rows), part.value});
  }
  return told;
}

}  // namespace

std::string sweep_json(const sweep::Table& table, std::optional<std::size_t> resumed) {
  SweepTold told{.title = table.title,
                 .study = table.study,
                 .keep = table.keep,
                 .points = table.points,
                 .points_failed = sweep::failed_points(table),
                 .points_resumed = resumed,
                 .results = {.rows = table.rows.size(), .sha256 = table.sha256}};
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    told.axes.push_back({table.axes[axis], if_said(table.units.axes[axis])});
  if (!table.units.force.empty()) told.units = SweepUnitsTold{.force = table.units.force};
  for (const std::string& method : sweep::methods(table))
    told.methods.push_back(method_told(table, method));
  if (!sweep::of_method(table, "").empty()) told.methods.push_back(method_told(table, ""));
  for (const auto& [why, rows] : sweep::failures(table)) told.failures.push_back({why, rows});
  return document_text(kind::sweep, told);
}

Json sweep_schema() {
  return document_schema<SweepTold>(kind::sweep, "What `sweep` and `merge` found");
}

}  // namespace report
}  // namespace tactile_net
