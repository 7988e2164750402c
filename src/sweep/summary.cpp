#include "tactile_net/sweep/summary.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::sweep {
namespace {

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

Group group(std::span<const Row* const> rows) {
  Group group{.rows = rows.size()};
  std::vector<double> errors;
  std::vector<double> alphas;
  for (const Row* row : rows) {
    if (row->verdict == "ok") ++group.trusted;
    if (row->verdict == "failed") ++group.failed;
    if (row->error) errors.push_back(*row->error);
    if (row->alpha) alphas.push_back(*row->alpha);
  }
  if (!errors.empty()) group.largest_error = *std::max_element(errors.begin(), errors.end());
  group.median_error = median(std::move(errors));
  group.median_alpha = median(std::move(alphas));
  return group;
}

std::vector<std::string> methods(const Table& table) {
  std::vector<std::string> all;
  for (const Row& row : table.rows)
    if (!row.method.empty() && std::find(all.begin(), all.end(), row.method) == all.end())
      all.push_back(row.method);
  return all;
}

std::vector<const Row*> of_method(const Table& table, std::string_view method) {
  std::vector<const Row*> rows;
  for (const Row& row : table.rows)
    if (row.method == method) rows.push_back(&row);
  return rows;
}

std::vector<Part> by_value(std::span<const Row* const> rows, std::size_t axis) {
  std::vector<Part> parts;
  std::map<std::string, std::size_t, std::less<>> places;
  for (const Row* row : rows) {
    const std::string& value = row->values[axis];
    const auto [place, is_new] = places.emplace(value, parts.size());
    if (is_new) {
      Part part{.value = value};
      if (double number = 0.0; read_number(value, number)) part.number = number;
      parts.push_back(std::move(part));
    }
    parts[place->second].rows.push_back(row);
  }
  if (std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.number; }))
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return *a.number < *b.number; });
  return parts;
}

bool can_be_listed(const Table& table, std::size_t axis, const std::vector<Part>& parts) {
  return table.axes[axis] != repeat_key && !parts.empty() && parts.size() <= most_listed_values;
}

std::size_t failed_points(const Table& table) {
  std::set<std::size_t> answered;
  for (const Row& row : table.rows)
    if (row.verdict != "failed") answered.insert(row.index);
  return table.points - answered.size();
}

std::vector<std::pair<std::string, std::size_t>> failures(const Table& table) {
  std::vector<std::pair<std::string, std::size_t>> all;
  for (const Row& row : table.rows) {
    if (row.failure.empty()) continue;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const auto& one) { return one.first == row.failure; });
    if (found == all.end())
      all.emplace_back(row.failure, 1);
    else
      ++found->second;
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return all;
}

}  // namespace tactile_net::sweep
