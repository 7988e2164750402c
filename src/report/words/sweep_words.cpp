#include "tactile_net/report/words/sweep_words.hpp"

#include <cmath>

#include "report/words/number_words.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::report {
namespace {

void add_cells(std::vector<std::string>& row, const sweep::Group& group) {
  for (const std::size_t count : {group.rows, group.trusted, group.failed})
    row.push_back(std::to_string(count));
  row.push_back(brief_or_dash(group.median_error));
  row.push_back(brief_or_dash(group.largest_error));
  row.push_back(brief_or_dash(group.median_alpha));
}

std::vector<std::string> headings(std::string first) {
  return {std::move(first), "rows",          "ok",          "failed",
          "median error",   "largest error", "median alpha"};
}

}  // namespace

std::string time_left(double seconds) {
  constexpr double minute = 60.0;
  constexpr double hour = 60.0 * minute;
  if (seconds < 1.5 * minute) return fixed(std::ceil(seconds), 0) + " s";
  if (seconds < 1.5 * hour) return fixed(std::ceil(seconds / minute), 0) + " min";
  return fixed(std::ceil(seconds / hour), 0) + " h";
}

std::string in_words(const sweep::Progress& progress) {
  std::string text = std::to_string(progress.done) + " of " + counted(progress.points, "point");
  if (progress.points > 0)
    text += ", " +
            fixed(100.0 * static_cast<double>(progress.done) / static_cast<double>(progress.points),
                  0) +
            " %";
  if (progress.seconds_left && !progress.complete())
    text += ", about " + time_left(*progress.seconds_left) + " left";
  return text;
}

std::string axis_in_words(const sweep::Table& table, std::size_t axis) {
  const std::string& unit = table.units.axes[axis];
  return table.axes[axis] + (unit.empty() ? "" : " [" + unit + "]");
}

std::string value_in_words(const sweep::Table& table, std::size_t axis, const std::string& value) {
  const std::string& unit = table.units.axes[axis];
  return table.axes[axis] + " = " + value + (unit.empty() ? "" : " " + unit);
}

std::vector<std::vector<std::string>> method_cells(const sweep::Table& table) {
  std::vector<std::vector<std::string>> cells = {headings("method")};
  for (const std::string& method : sweep::methods(table)) {
    cells.push_back({method});
    add_cells(cells.back(), sweep::group(sweep::of_method(table, method)));
  }
  if (const auto none = sweep::of_method(table, ""); !none.empty()) {
    cells.push_back({"(no method)"});
    add_cells(cells.back(), sweep::group(none));
  }
  return cells;
}

std::vector<std::vector<std::string>> value_cells(const sweep::Table& table,
                                                  const std::string& method, std::size_t axis) {
  std::vector<std::vector<std::string>> cells = {headings(axis_in_words(table, axis))};
  for (const sweep::Part& part : sweep::by_value(sweep::of_method(table, method), axis)) {
    cells.push_back({part.value});
    add_cells(cells.back(), sweep::group(part.rows));
  }
  return cells;
}

std::vector<std::string> failures_in_words(const sweep::Table& table) {
  constexpr std::size_t most = 10;
  const auto all = sweep::failures(table);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < all.size() && i < most; ++i)
    texts.push_back(counted(all[i].second, "row") + ": " + all[i].first);
  if (all.size() > most) texts.push_back(counted(all.size() - most, "more reason"));
  return texts;
}

std::string nothing_found_in_words(const sweep::Table& table) {
  if (table.rows.empty() || sweep::failed_points(table) < table.points) return {};
  const sweep::Row& first = table.rows.front();
  std::vector<std::string> values;
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    values.push_back(value_in_words(table, axis, first.values[axis]));
  return "no point has an answer; the first, " + join(values, ", ") + ": " + first.failure;
}

}  // namespace tactile_net::report
