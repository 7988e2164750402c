#include "tactile_net/sweep/rows_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "tactile_net/frames/cannot_create.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::sweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "tactile-net sweep 3";

[[noreturn]] void refuse(const fs::path& file, std::size_t line, std::string message,
                         std::string hint) {
  throw InputError({{.file = file.string(),
                     .line = line,
                     .message = std::move(message),
                     .hint = std::move(hint)}});
}

std::string content_of(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    refuse(path, 0, "is a folder", "name the file of rows that the sweep wrote");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, 0, "cannot be read", "is the file there, and yours to read?");
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

/// Whether the writer was stopped before the head was whole.
bool is_begun_head(std::string_view content) {
  return std::count(content.begin(), content.end(), '\n') < 2 &&
         (content.starts_with(mark) || mark.starts_with(content));
}

/// Takes the head off a text. @throw InputError  it does not begin with one
RowsHead take_head(std::string_view& text, const fs::path& file) {
  const auto no_head = [&] {
    refuse(file, 1, "is not a file of rows that a sweep wrote", "name another file");
  };
  const auto first = next_line(text);
  const auto second = next_line(text);
  if (!first || !second) no_head();
  const std::vector<std::string> said = fields(*first);
  if (said.size() < 6 || said[0] != mark) no_head();
  const auto points = whole_number(said[3]);
  const std::vector<std::string> names = fields(*second);
  const auto seed = std::find(names.begin(), names.end(), "seed");
  if (!points || names.size() < 3 || names[1] != "index" || seed == names.end()) no_head();
  RowsHead head{said[1], said[2], *points, said[4], {names.begin() + 2, seed}};
  for (auto column = seed; column != names.end(); ++column)
    if (const auto kept = kept_named(*column)) head.keep.push_back(*kept);
  head.units = {{said.begin() + 6, said.end()}, said[5]};
  if (head.units.axes.size() != head.axes.size()) no_head();
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
  if (!part || !parts || !index || *part < 1 || *part > *parts) return std::nullopt;
  return Line{*part, *parts, *index, row};
}

}  // namespace

RowsHead head_of(const Study& study) {
  RowsHead head{std::string(version()),
                study.hash(),
                study.points(),
                study.title().empty() ? study.file() : study.title(),
                {},
                study.keep(),
                study.units()};
  for (const Axis& axis : study.axes()) head.axes.push_back(axis.key);
  return head;
}

std::string text(const RowsHead& head) {
  std::string text = std::string(mark) + ',' + head.version + ',' + head.study + ',' +
                     std::to_string(head.points) + ',' + csv_quoted(head.title) + ',' +
                     head.units.force;
  for (const std::string& unit : head.units.axes) text += ',' + unit;
  return text + "\nrow," + header(head.axes, head.keep) + '\n';
}

std::string lines(const std::vector<Row>& rows, const std::vector<Kept>& keep) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
    text +=
        std::to_string(i + 1) + '/' + std::to_string(rows.size()) + ',' + csv(rows[i], keep) + '\n';
  return text;
}

std::optional<RowsHead> read_head(const fs::path& file) {
  const std::string content = content_of(file);
  std::string_view rest = content;
  if (is_begun_head(rest)) return std::nullopt;
  return take_head(rest, file);
}

void Rows::add(const fs::path& file) {
  const std::string content = content_of(file);
  if (!is_begun_head(content)) (void)add(content, file);
}

std::size_t Rows::add(std::string_view content, const fs::path& file) {
  std::string_view rest = content;
  const RowsHead head = take_head(rest, file);
  if (head.version != head_.version)
    refuse(file, 1, "was written by tactile-net " + head.version + ", and this is " + head_.version,
           "go on with that version, or begin another file");
  if (head.study != head_.study || head.points != head_.points)
    refuse(file, 1, "holds the rows of another study",
           "a study that was changed begins another file");

  const auto read = [&] { return content.size() - rest.size(); };
  std::size_t whole = read();
  std::map<std::size_t, std::map<std::size_t, std::string>> begun;  // points, their rows so far
  std::size_t number = 2;
  while (const auto text = next_line(rest)) {
    ++number;
    const auto line = line_in(*text);
    if (!line || line->index >= head_.points || !row_in(line->row, head_.axes.size(), head_.keep))
      refuse(file, number, "is not a row of this sweep",
             "delete the line: its point is done again");
    auto& parts = begun[line->index];
    parts[line->part] = line->row;
    if (parts.size() < line->parts) continue;
    std::vector<std::string> rows;
    for (auto& [part, row] : parts) rows.push_back(std::move(row));
    begun.erase(line->index);
    const auto [place, is_new] = points_.emplace(line->index, rows);
    if (!is_new && place->second != rows)
      refuse(file, number,
             "has another answer to point " + std::to_string(line->index) + " than stands before",
             "machines of other processors have other last digits: keep one of the two answers");
    whole = read();
  }
  return whole;
}

RowsFile::RowsFile(const Study& study, fs::path path)
    : path_(std::move(path)), rows_(head_of(study)) {
  const auto fail = [this](const std::string& why) {
    throw frames::CannotCreate(path_.string() + ": error: " + why);
  };
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0644);
  if (file_ < 0) fail(std::string("cannot be written to: ") + std::strerror(errno));
  try {
    struct stat state {};
    if (::fstat(file_, &state) != 0 || !S_ISREG(state.st_mode))
      fail("is not a file: name one, which a sweep that was stopped goes on with");
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      fail("another sweep writes into this file: wait until it ends, or name another file");
    const std::string content = content_of(path_);
    const bool is_new = is_begun_head(content);
    if (!is_new) size_ = rows_.add(content, path_);
    if (size_ < content.size() && ::ftruncate(file_, static_cast<off_t>(size_)) != 0)
      fail(std::string("its last point is not whole and cannot be cut off: ") +
           std::strerror(errno));
    if (is_new) append(text(rows_.head()));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

void RowsFile::close() noexcept {
  if (file_ < 0) return;
  ::flock(file_, LOCK_UN);  // for a child that is on its way to another program too
  ::close(std::exchange(file_, -1));
}

void RowsFile::append(std::string_view lines) {
  ssize_t written = 0;
  do written = ::write(file_, lines.data(), lines.size());
  while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(lines.size())) {
    size_ += lines.size();
    return;
  }
  const int reason = written < 0 ? errno : ENOSPC;
  const bool cut = ::ftruncate(file_, static_cast<off_t>(size_)) == 0;
  throw std::runtime_error(path_.string() + " could not be written: " + std::strerror(reason) +
                           "; what was done before is kept" +
                           (cut ? "" : ", behind it half a row") +
                           ": run the same sweep again to go on");
}

}  // namespace tactile_net::sweep
