#include "tactile_net/sweep/merge.hpp"

#include <optional>
#include <utility>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/sha256.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::sweep {
namespace {

/// "3, 7:10, 12 and 5 more ranges": as many as one reads.
std::string ranges_in_words(const std::vector<std::size_t>& rising) {
  constexpr std::size_t most = 10;
  std::vector<std::string> ranges;
  std::size_t more = 0;
  for (std::size_t i = 0; i < rising.size();) {
    const std::size_t first = i;
    while (i < rising.size() && rising[i] - rising[first] == i - first) ++i;
    if (ranges.size() == most)
      ++more;
    else if (i - first == 1)
      ranges.push_back(std::to_string(rising[first]));
    else
      ranges.push_back(std::to_string(rising[first]) + ':' + std::to_string(rising[i - 1] + 1));
  }
  return join(ranges, ", ") + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

}  // namespace

PointRange point_range_in(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto first = whole_number(text.substr(0, colon));
  const auto end = colon == text.npos ? std::nullopt : whole_number(text.substr(colon + 1));
  if (!first || !end)
    throw std::invalid_argument("'" + std::string(text) +
                                "' is not a range of points: the first ten are 0:10");
  if (*first >= *end)
    throw std::invalid_argument("'" + std::string(text) +
                                "' has no point: the second number is the first that is left out");
  return {*first, *end};
}

MissingPoints::MissingPoints(const std::vector<std::size_t>& missing, std::size_t points)
    : std::runtime_error((missing.size() == 1
                              ? "point " + std::to_string(missing.front()) + " of " +
                                    std::to_string(points) + " is missing"
                              : std::to_string(missing.size()) + " of " + std::to_string(points) +
                                    " points are missing, " + ranges_in_words(missing)) +
                         ": run the same sweep again to compute what is missing") {}

Table table(const Rows& rows, const PointRange& range) {
  const RowsHead& head = rows.head();
  Table table{.title = head.title,
              .study = head.study,
              .axes = head.axes,
              .units = head.units,
              .keep = head.keep};
  std::vector<std::size_t> missing;
  table.csv = header(head.axes, head.keep) + '\n';
  for (std::size_t index = range.first; index < range.end_in(head.points); ++index) {
    ++table.points;
    const auto point = rows.points().find(index);
    if (point == rows.points().end()) {
      missing.push_back(index);
      continue;
    }
    for (const std::string& line : point->second) {
      table.rows.push_back(*row_in(line, head.axes.size(), head.keep));
      (table.csv += line) += '\n';
    }
  }
  if (!missing.empty()) throw MissingPoints(missing, table.points);
  table.sha256 = sha256_text(table.csv);
  return table;
}

Table merge(std::span<const std::filesystem::path> files, const PointRange& range) {
  std::optional<RowsHead> head;
  for (const auto& file : files)
    if (!head) head = read_head(file);
  if (!head)
    throw InputError({{.file = files.empty() ? "merge" : files.front().string(),
                       .message = "has no row",
                       .hint = "name files of rows that sweeps wrote"}});
  Rows rows(*std::move(head));
  for (const auto& file : files) rows.add(file);
  return table(rows, range);
}

}  // namespace tactile_net::sweep
