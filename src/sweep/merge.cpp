#include "tactile_net/sweep/merge.hpp"

#include <optional>
#include <utility>

#include "tactile_net/numeric/sha256.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::sweep {

MissingPoints::MissingPoints(std::size_t missing, std::size_t points, std::size_t first)
    : std::runtime_error(
          (missing == 1
               ? "point " + std::to_string(first) + " of " + std::to_string(points) + " is missing"
               : std::to_string(missing) + " of " + std::to_string(points) +
                     " points are missing, " + std::to_string(first) + " first") +
          ": run the same sweep again to compute what is missing") {}

namespace {

Table table_of(const Rows& rows, const Shard& shard) {
  const JournalHead& head = rows.head();
  Table table{.title = head.title,
              .study = head.hash,
              .axes = head.axes,
              .units = head.units,
              .keep = head.keep};
  std::size_t missing = 0;
  std::size_t first = 0;
  for (std::size_t index = 0; index < head.points; ++index) {
    if (!shard.has(index)) continue;
    ++table.points;
    if (rows.has(index)) continue;
    if (missing++ == 0) first = index;
  }
  if (missing > 0) throw MissingPoints(missing, table.points, first);
  table.csv = header(head.axes, head.keep) + '\n';
  for (const auto& [index, lines] : rows.points()) {
    if (!shard.has(index)) continue;
    for (const std::string& line : lines) {
      table.rows.push_back(*row_in(line, head.axes.size(), head.keep));
      (table.csv += line) += '\n';
    }
  }
  table.sha256 = sha256_text(table.csv);
  return table;
}

}  // namespace

Table table(const Rows& rows) { return table_of(rows, {}); }

Table shard_table(const Study& study, const std::filesystem::path& folder, const Shard& shard) {
  Rows rows(head_of(study));
  for (const auto& journal : journals_in(folder)) rows.add(journal);
  return table_of(rows, shard);
}

Table merge(std::span<const std::filesystem::path> folders) {
  std::vector<std::filesystem::path> journals;
  for (const auto& folder : folders)
    for (auto& journal : journals_in(folder)) journals.push_back(std::move(journal));
  std::optional<JournalHead> head;
  for (const auto& journal : journals)
    if (!head) head = read_head(journal);
  if (!head)
    throw InputError({{.file = folders.empty() ? "merge" : folders.front().string(),
                       .message = "holds no journal of a sweep",
                       .hint = "name the folder that the sweep was written into"}});
  Rows rows(*std::move(head));
  for (const auto& journal : journals) rows.add(journal);
  return table(rows);
}

}  // namespace tactile_net::sweep
