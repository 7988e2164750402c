#include "tactile_net/frames/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <map>
#include <ostream>
#include <stdexcept>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

constexpr std::ptrdiff_t ignored_field = -1;
constexpr std::ptrdiff_t time_field = -2;

/// Without surrounding blanks and quotes.
std::string_view trimmed(std::string_view field) {
  const auto is_padding = [](char c) { return c == ' ' || c == '\t' || c == '"'; };
  while (!field.empty() && is_padding(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_padding(field.back())) field.remove_suffix(1);
  return field;
}

/// Cuts the first field off a row; `more` tells whether another follows.
std::string_view take_field(std::string_view& rest, bool& more) {
  const std::size_t comma = rest.find(',');
  more = comma != std::string_view::npos;
  const std::string_view field = rest.substr(0, comma);
  rest.remove_prefix(more ? comma + 1 : rest.size());
  return field;
}

/// std::from_chars takes no leading '+'.
std::string_view without_plus(std::string_view field) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  return field;
}

}  // namespace

CsvFrames::CsvFrames(std::istream& in, std::string file)
    : in_(in), file_(std::move(file)), buffer_(longest_line) {}

CsvFrames::CsvFrames(std::istream& in, std::string file, std::vector<std::string> columns,
                     std::vector<bool> unread)
    : CsvFrames(in, std::move(file)) {
  unread_ = std::move(unread);
  if (!read_line())
    fail({}, "no header: the file is empty",
         "line 1 names the columns: " + columns.front() + ", ..., " + columns.back());
  read_header();
  find(std::move(columns));
}

CsvFrames::CsvFrames(std::istream& in, std::string file, const ChooseColumns& choose)
    : CsvFrames(in, std::move(file)) {
  if (!read_line()) fail({}, "no header: the file is empty", "line 1 names the columns");
  read_header();
  find(choose(header_));
}

void CsvFrames::read_header() {
  std::string_view rest = row_;
  for (bool more = true; more;) {
    const std::string_view field = take_field(rest, more);
    std::string name(trimmed(field));
    if (std::find(header_.begin(), header_.end(), name) != header_.end())
      fail(field, "column '" + name + "' stands twice");
    header_.push_back(std::move(name));
  }
}

void CsvFrames::find(std::vector<std::string> columns) {
  columns_ = std::move(columns);
  unread_.resize(columns_.size());
  std::map<std::string_view, std::ptrdiff_t> wanted;
  for (const std::string& column : columns_)
    wanted.emplace(column, static_cast<std::ptrdiff_t>(wanted.size()));

  std::vector<bool> found(columns_.size());
  for (const std::string& name : header_) {
    const auto match = wanted.find(name);
    if (match != wanted.end()) {
      target_.push_back(match->second);
      found[static_cast<std::size_t>(match->second)] = true;
    } else if (name == "t" && target_.empty()) {
      target_.push_back(time_field);
      has_time_ = true;
    } else {
      target_.push_back(ignored_field);
      ignored_.push_back(name);
    }
  }

  const auto missing = std::count(found.begin(), found.end(), false);
  if (missing == 0) return;
  const auto first = std::find(found.begin(), found.end(), false) - found.begin();
  fail(row_,
       "column '" + columns_[static_cast<std::size_t>(first)] + "' is missing" +
           (missing > 1 ? " and " + std::to_string(missing - 1) + " more" : ""),
       "the scene reads " + std::to_string(columns_.size()) + " columns, " + columns_.front() +
           " to " + columns_.back());
}

bool CsvFrames::read_line() {
  do {
    in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    if (in_.gcount() == 0 && in_.eof()) return false;
    ++line_;
    if (in_.bad()) fail({}, "cannot be read");
    if (in_.fail() && !in_.eof())
      fail({}, "a line is longer than " + std::to_string(longest_line) + " bytes",
           "is this a CSV file?");
    row_ = {buffer_.data(), static_cast<std::size_t>(in_.gcount()) - (in_.eof() ? 0 : 1)};
    if (!row_.empty() && row_.back() == '\r') row_.remove_suffix(1);
  } while (row_.empty());
  return true;
}

void CsvFrames::fail(std::string_view field, const std::string& message,
                     const std::string& hint) const {
  const bool inside = !row_.empty() && field.data() != nullptr;
  throw InputError({{.file = file_,
                     .line = line_,
                     .column = inside ? static_cast<std::size_t>(field.data() - row_.data()) + 1
                                      : std::size_t{1},
                     .message = message,
                     .hint = hint}});
}

bool CsvFrames::next(std::span<double> values) {
  if (!read_line()) return false;
  std::string_view rest = row_;
  std::size_t fields = 0;
  for (bool more = true; more; ++fields) {
    const std::string_view raw = take_field(rest, more);
    if (fields >= target_.size())
      fail(raw, "more than the header's " + std::to_string(target_.size()) + " columns");
    const std::ptrdiff_t target = target_[fields];
    if (target == ignored_field) continue;
    if (target >= 0 && unread_[static_cast<std::size_t>(target)]) {
      values[static_cast<std::size_t>(target)] = 0.0;
      continue;
    }

    const std::string_view field = without_plus(trimmed(raw));
    double value = 0.0;
    const auto [end, error] = number_from_chars(field.data(), field.data() + field.size(), value);
    const auto column = [&] { return "(column " + header_[fields] + ")"; };
    if (field.empty()) fail(raw, "a number is missing " + column());
    if (error == std::errc::result_out_of_range)
      fail(raw, "'" + std::string(field) + "' is beyond the range of a double " + column());
    if (error != std::errc{} || end != field.data() + field.size())
      fail(raw, "'" + std::string(field.substr(0, 40)) + "' is not a number " + column());
    if (!std::isfinite(value))
      fail(raw, "'" + std::string(field) + "' is not finite " + column(),
           "list the taxel under [dead_taxels] if it is broken");
    if (target == time_field)
      time_ = field;
    else
      values[static_cast<std::size_t>(target)] = value;
  }
  if (fields < target_.size())
    fail(row_.substr(row_.size()), "the row has " + std::to_string(fields) +
                                       " columns, the header " + std::to_string(target_.size()));
  return true;
}

void CsvFrames::refuse(const std::string& message, const std::string& hint) const {
  fail(row_, message, hint);
}

CsvSink::CsvSink(std::ostream& out, std::span<const std::string> columns, bool with_time)
    : out_(out), with_time_(with_time) {
  append_header(text_, columns, with_time);
}

void CsvSink::add(std::string_view time, std::span<const double> values) {
  constexpr std::size_t block = 1 << 16;
  if (with_time_) text_.append(time) += ',';
  append_row(text_, values);
  if (text_.size() >= block) flush();
}

void CsvSink::flush() {
  out_.write(text_.data(), std::ssize(text_));
  text_.clear();
  if (!out_) throw std::runtime_error("the frames could not be written: is the disk full?");
}

void append_header(std::string& out, std::span<const std::string> columns, bool with_time) {
  if (with_time) out += "t,";
  for (const std::string& column : columns) out.append(column) += ',';
  out.back() = '\n';
}

void append_row(std::string& out, std::span<const double> values) {
  for (const double value : values) {
    if (!std::isnan(value)) append_number(out, value);
    out += ',';
  }
  if (!values.empty()) out.back() = '\n';
}

}  // namespace tactile_net::frames
