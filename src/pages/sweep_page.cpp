#include "tactile_net/pages/sweep_page.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pages/parts.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/sweep_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::Figures;
using drawing::Page;
using drawing::Plot;
using sweep::Part;
using sweep::Row;
using sweep::Table;
using Rows = std::vector<const Row*>;

/// What is drawn over an axis.
struct PlottedQuantity {
  std::string_view name;  ///< of its files
  std::string_view label;
  std::optional<double> Row::*of;
  std::optional<double> sweep::Group::*median;
};

constexpr PlottedQuantity quantities[] = {
    {"error", "|f - truth| / |truth|, normal", &Row::error, &sweep::Group::median_error},
    {"alpha", "alpha", &Row::alpha, &sweep::Group::median_alpha},
};

constexpr std::size_t most_curves = 8;

/// A repeat's number says nothing; text has no place on an axis.
bool can_be_drawn(const Table& table, std::size_t axis) {
  if (table.axes[axis] == sweep::repeat_key) return false;
  Rows all;
  for (const Row& row : table.rows) all.push_back(&row);
  const std::vector<Part> parts = sweep::by_value(all, axis);
  return parts.size() > 1 &&
         std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.number; });
}

bool spans_decades(const std::vector<Part>& parts) {
  constexpr double wide = 30.0;
  return *parts.front().number > 0.0 && *parts.back().number / *parts.front().number >= wide;
}

/// Rows that make one curve.
struct Bundle {
  std::string label{};
  Rows rows{};
};

/// A bundle for each method, or for each method and value of the one other axis that has few.
std::vector<Bundle> bundles(const Table& table, std::size_t axis) {
  std::vector<Bundle> by_method;
  for (const std::string& method : sweep::methods(table))
    by_method.push_back({method, sweep::of_method(table, method)});
  std::vector<Bundle> finest = by_method;
  std::size_t fewest = most_curves + 1;
  for (std::size_t other = 0; other < table.axes.size(); ++other) {
    if (other == axis || table.axes[other] == sweep::repeat_key) continue;
    std::vector<Bundle> finer;
    for (const Bundle& bundle : by_method) {
      const std::string before = by_method.size() > 1 ? bundle.label + ", " : "";
      for (Part& part : sweep::by_value(bundle.rows, other))
        finer.push_back(
            {before + report::value_in_words(table, other, part.value), std::move(part.rows)});
    }
    if (finer.size() <= by_method.size() || finer.size() >= fewest) continue;
    fewest = finer.size();
    finest = std::move(finer);
  }
  return finest;
}

Curve points(const Rows& rows, std::size_t axis, const PlottedQuantity& quantity) {
  Curve curve{.label = "single rows", .y = {}, .dots = true};
  for (const Part& part : sweep::by_value(rows, axis))
    for (const Row* row : part.rows)
      if (const auto value = row->*quantity.of) {
        curve.x.push_back(*part.number);
        curve.y.push_back(*value);
      }
  return curve;
}

Plot plot_over(const Table& table, std::size_t axis, const PlottedQuantity& quantity) {
  Plot plot{.title = table.axes[axis],
            .x_label = report::axis_in_words(table, axis),
            .y_label = std::string(quantity.label),
            .x = {},
            .curves = {},
            .logarithmic_y = true,
            .quiet_label = "single rows"};
  Rows all;
  for (const Row& row : table.rows)
    if (!row.method.empty()) all.push_back(&row);
  const std::vector<Part> parts = sweep::by_value(all, axis);
  plot.logarithmic_x = spans_decades(parts);
  if (parts.size() > sweep::most_listed_values) {
    for (const std::string& method : sweep::methods(table)) {
      Curve curve = points(sweep::of_method(table, method), axis, quantity);
      curve.label = method;
      curve.colour = plot.curves.size() + 1;
      plot.curves.push_back(std::move(curve));
    }
    return plot;
  }
  Curve quiet = points(all, axis, quantity);
  quiet.quiet = true;
  std::size_t medians = 0;
  for (const Bundle& bundle : bundles(table, axis)) {
    Curve curve{.label = bundle.label, .y = {}, .colour = plot.curves.size() + 1, .marks = true};
    for (const Part& part : sweep::by_value(bundle.rows, axis))
      if (const auto median = sweep::group(part.rows).*quantity.median) {
        curve.x.push_back(*part.number);
        curve.y.push_back(*median);
      }
    medians += curve.y.size();
    if (!curve.y.empty()) plot.curves.push_back(std::move(curve));
  }
  if (quiet.y.size() > medians) plot.curves.insert(plot.curves.begin(), std::move(quiet));
  return plot;
}

/// Whether there is anything to see: an alpha that the scene gives is one number.
bool varies(const Table& table, const PlottedQuantity& quantity) {
  std::optional<double> first;
  for (const Row& row : table.rows) {
    const auto value = row.*quantity.of;
    if (!first) first = value;
    if (value && value != first) return true;
  }
  return false;
}

std::vector<Figure> figures_of(const Table& table) {
  std::vector<Figure> figures;
  for (const PlottedQuantity& quantity : quantities) {
    if (!varies(table, quantity)) continue;
    for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
      if (can_be_drawn(table, axis))
        figures.push_back(
            {.name = std::string(quantity.name) + "-" + std::to_string(axis + 1),
             .section = std::string(quantity.name),
             .caption = "The " + std::string(quantity.name) + " over " + table.axes[axis] +
                        ": lines are medians over all that is not named, grey are the rows "
                        "themselves.",
             .plot = plot_over(table, axis, quantity)});
  }
  return figures;
}

/// Whether every method has an answer, and which has the smallest error.
std::vector<report::Answer> answers(const Table& table) {
  const auto rows = static_cast<double>(table.rows.size());
  std::size_t trusted = 0;
  std::size_t failed = 0;
  const Row* best = nullptr;
  for (const Row& row : table.rows) {
    if (row.verdict == "ok") ++trusted;
    if (row.verdict == "failed") ++failed;
    if (row.verdict == "ok" && row.error && (best == nullptr || *row.error < *best->error))
      best = &row;
  }
  std::vector<report::Answer> all = {
      {counted(table.points, "point"),
       counted(table.rows.size(), "row") + ": one for each point and method"},
      {percent(static_cast<double>(trusted) / rows), "of the rows have the verdict ok",
       2 * trusted < table.rows.size()}};
  if (failed > 0)
    all.push_back({counted(failed, "row"), failed == 1 ? "has no answer" : "have no answer", true});
  if (best != nullptr) {
    std::string where = "is the smallest error: " + best->method;
    for (std::size_t i = 0; i < table.axes.size(); ++i)
      where += ", " + report::value_in_words(table, i, best->values[i]);
    all.push_back({percent(*best->error), where});
  }
  return all;
}

}  // namespace

Page sweep_page(const Table& table, const Made& made) {
  const Figures figures(figures_of(table));
  Page page{.files = figures.data()};

  std::string html = heading("", table.title, "a scene at " + counted(table.points, "point"));
  html += answer_box(answers(table));
  html += "<h2>How far from the truth</h2>\n" + figures.html("error");
  html += drawing::html_table(report::method_cells(table));
  if (const std::string alphas = figures.html("alpha"); !alphas.empty())
    html += "<h2>What the rule chooses</h2>\n" + alphas;
  html += "<h2>Axis by axis</h2>\n";
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    for (const std::string& method : sweep::methods(table)) {
      const auto parts = sweep::by_value(sweep::of_method(table, method), axis);
      if (!sweep::can_be_listed(table, axis, parts)) continue;
      html += "<details>" + element("summary", table.axes[axis] + ", " + method) +
              drawing::html_table(report::value_cells(table, method, axis)) + "</details>\n";
    }
  if (const auto failures = report::failures_in_words(table); !failures.empty())
    html += "<h2>Without an answer</h2>\n" + drawing::html_list(failures);
  html += colophon("The rows, their hash, the command",
                   "<p>SHA-256 of results.csv: <code>" + table.sha256 + "</code></p>\n", page.files,
                   made);
  page.html = page_html(table.title + " - tactile-net sweep", html);
  return page;
}

}  // namespace tactile_net::pages
