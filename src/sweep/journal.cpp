#include "tactile_net/sweep/journal.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::sweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "tactile-net sweep 2";
constexpr std::string_view extension = ".journal";

[[noreturn]] void refuse(const fs::path& file, std::size_t line, std::string message,
                         std::string hint) {
  throw InputError({{.file = file.string(),
                     .line = line,
                     .message = std::move(message),
                     .hint = std::move(hint)}});
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, 0, "cannot be read", "is the folder there, and yours to read?");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The next line, without its end; nothing: no whole one is left.
std::optional<std::string_view> next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == text.npos) return std::nullopt;
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return line;
}

/// The head of a text that begins with one; nothing: it does not, or not wholly.
std::optional<JournalHead> take_head(std::string_view& text) {
  const auto first = next_line(text);
  const auto second = next_line(text);
  if (!first || !second) return std::nullopt;
  const std::vector<std::string> said = fields(*first);
  if (said.size() < 6 || said[0] != mark) return std::nullopt;
  const auto points = whole_number(said[3]);
  const std::vector<std::string> names = fields(*second);
  const auto seed = std::find(names.begin(), names.end(), "seed");
  if (!points || names.front() != "index" || seed == names.end()) return std::nullopt;
  JournalHead head{said[1], said[2], *points, said[4], {names.begin() + 1, seed}};
  for (auto column = seed; column != names.end(); ++column)
    if (const auto kept = kept_named(*column)) head.keep.push_back(*kept);
  head.units = {{said.begin() + 6, said.end()}, said[5]};
  if (head.units.axes.size() != head.axes.size()) return std::nullopt;
  return head;
}

/// The same; nothing where its writer has just begun, or was stopped before it had.
std::optional<JournalHead> begun_head(std::string_view& text, const fs::path& journal) {
  const std::string_view all = text;
  auto head = take_head(text);
  const bool begun = std::count(all.begin(), all.end(), '\n') < 2 &&
                     (all.starts_with(mark) || mark.starts_with(all));
  if (!head && !begun)
    refuse(journal, 1, "is not a journal of a sweep", "take it out of the folder");
  return head;
}

/// "I/N," and what follows.
struct Line {
  std::size_t part = 0;
  std::size_t parts = 0;
  std::size_t index = 0;
  std::string_view row{};
};

std::optional<Line> line_in(std::string_view text) {
  const std::size_t comma = text.find(',');
  const std::size_t slash = text.substr(0, comma).find('/');
  if (comma == text.npos || slash == text.npos) return std::nullopt;
  const std::string_view row = text.substr(comma + 1);
  const auto part = whole_number(text.substr(0, slash));
  const auto parts = whole_number(text.substr(slash + 1, comma - slash - 1));
  const auto index = whole_number(row.substr(0, row.find(',')));
  if (!part || !parts || !index || *part > *parts || (*part == 0) != (*parts == 0))
    return std::nullopt;
  return Line{*part, *parts, *index, row};
}

}  // namespace

JournalHead head_of(const Study& study) {
  JournalHead head{std::string(version()),
                   study.hash(),
                   study.points(),
                   study.title().empty() ? study.file() : study.title(),
                   {},
                   study.keep(),
                   study.units()};
  for (const Axis& axis : study.axes()) head.axes.push_back(axis.key);
  return head;
}

std::string text(const JournalHead& head) {
  std::string text = std::string(mark) + ',' + head.version + ',' + head.hash + ',' +
                     std::to_string(head.points) + ',' + csv_quoted(head.title) + ',' +
                     head.units.force;
  for (const std::string& unit : head.units.axes) text += ',' + unit;
  return text + '\n' + header(head.axes, head.keep) + '\n';
}

std::string lines(const std::vector<Row>& rows, const std::vector<Kept>& keep) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
    text +=
        std::to_string(i + 1) + '/' + std::to_string(rows.size()) + ',' + csv(rows[i], keep) + '\n';
  return text;
}

std::string death_line(const Row& row, const std::vector<Kept>& keep) {
  return "0/0," + csv(row, keep) + '\n';
}

std::vector<fs::path> journals_in(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    refuse(folder, 0, "is not a folder", "name the folder that the sweep was written into");
  std::vector<fs::path> found;
  const auto search = [&](const fs::path& place, const auto& into, int deeper) -> void {
    for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
      if (entry.is_directory(error) && deeper > 0)
        into(entry.path(), into, deeper - 1);
      else if (entry.path().extension() == extension && entry.is_regular_file(error))
        found.push_back(entry.path());
    }
    if (error) refuse(place, 0, "cannot be read: " + error.message(), "is it yours to read?");
  };
  search(folder, search, 1);
  std::sort(found.begin(), found.end());
  return found;
}

void drop_torn_line(const fs::path& journal) {
  const std::string content = content_of(journal);
  std::string_view rest = content;
  const std::size_t whole = take_head(rest) ? content.rfind('\n') + 1 : 0;
  // What begins as no journal does is somebody's own, and `Rows::add` says so.
  if (whole == 0 && content.find('\n') != content.npos && !content.starts_with(mark)) return;
  if (whole < content.size()) fs::resize_file(journal, whole);
}

std::optional<JournalHead> read_head(const fs::path& journal) {
  const std::string content = content_of(journal);
  std::string_view rest = content;
  return begun_head(rest, journal);
}

void Rows::add(const fs::path& journal) {
  const std::string content = content_of(journal);
  std::string_view rest = content;
  const auto head = begun_head(rest, journal);
  if (!head) return;
  if (head->version != head_.version)
    refuse(journal, 1,
           "was written by tactile-net " + head->version + ", and this is " + head_.version,
           "go on with that version, or begin in another folder");
  if (!(*head == head_))
    refuse(journal, 1, "is the journal of another study",
           "a study that was changed begins in another folder");

  std::map<std::size_t, std::map<std::size_t, std::string>> begun;  // points, their rows so far
  std::size_t number = 2;
  while (const auto text = next_line(rest)) {
    ++number;
    const auto line = line_in(*text);
    if (!line || line->index >= head_.points || !row_in(line->row, head_.axes.size(), head_.keep))
      refuse(journal, number, "is not a row of this sweep",
             "delete the line: its point is done again");
    if (line->parts == 0) {
      if (!points_.contains(line->index)) {
        deaths_.emplace(line->index, line->row);
        points_.emplace(line->index, std::vector{std::string(line->row)});
      }
      continue;
    }
    auto& parts = begun[line->index];
    parts[line->part] = line->row;
    if (parts.size() < line->parts) continue;
    std::vector<std::string> rows;
    for (auto& [part, row] : parts) rows.push_back(std::move(row));
    begun.erase(line->index);
    if (deaths_.erase(line->index) > 0) points_.erase(line->index);
    const auto [place, is_new] = points_.emplace(line->index, rows);
    if (!is_new && place->second != rows)
      refuse(journal, number,
             "has another answer to point " + std::to_string(line->index) +
                 " than the journals before it",
             "machines of other processors have other last digits: keep one of the two journals");
  }
}

}  // namespace tactile_net::sweep
