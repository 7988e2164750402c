#include "tactile_net/frames/csv.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "frames/column_match.hpp"
#include "frames/csv_header.hpp"
#include "frames/field_value.hpp"
#include "frames/foreign_format.hpp"
#include "frames/missing_hint.hpp"
#include "frames/text_lines.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

/// What may stand in a column of times besides a number, and be copied into a field of CSV: dates
/// and clock times.
bool is_moment(std::string_view text) {
  const auto fits = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == ':' ||
           c == '-' || c == '+' || c == '.' || c == '/' || c == ' ';
  };
  return !text.empty() && text.front() >= '0' && text.front() <= '9' &&
         std::all_of(text.begin(), text.end(), fits);
}

}  // namespace

class CsvFrames::Reader {
 public:
  Reader(std::istream& in, std::string file) : lines_(in), file_(std::move(file)) {}

  void open(const WantedColumns& wanted, const ChooseColumns* choose) {
    wanted_ = wanted;
    read_names();
    if (choose != nullptr) {
      if (header_.names.empty())
        fail(row_, "there is no header: the first line holds numbers", "line 1 names the columns");
      wanted_.names = (*choose)(header_.names);
    }
    wanted_.unread.resize(wanted_.names.size());
    try {
      match_ = header_.names.empty() ? match_unnamed(header_.row_fields, wanted_)
                                     : match_columns(header_.names, wanted_);
    } catch (const NoMatch& no) {
      const std::size_t at = no.field < header_.at.size() ? header_.at[no.field] : 0;
      throw InputError({{.file = file_,
                         .line = lines_.number(),
                         .column = at + 1,
                         .message = no.what(),
                         .hint = no.hint}});
    }
  }

  CsvColumns columns() {
    read_names();
    return {header_.names, header_.names.empty() ? header_.row_fields : header_.names.size()};
  }

  bool next(std::span<double> values) {
    if (!std::exchange(header_.row_pending, false)) {
      if (!read_line()) return false;
    }
    const CsvLayout layout = header_.layout;
    const std::vector<std::ptrdiff_t>& targets = match_.target;
    std::string_view rest = row_;
    std::size_t fields = 0;
    for (bool more = true; more; ++fields) {
      const std::string_view raw = take_field(rest, more, layout);
      if (fields >= targets.size())
        fail(raw, "more than the header's " + std::to_string(targets.size()) + " columns");
      const std::ptrdiff_t target = targets[fields];
      if (target >= 0) {
        const auto index = static_cast<std::size_t>(target);
        values[index] = wanted_.unread[index] ? 0.0 : reading(raw, fields);
      } else if (target == ColumnMatch::time_field) {
        read_time(raw, fields);
      }
    }
    if (fields < targets.size())
      fail(row_.substr(row_.size()), "the row has " + std::to_string(fields) +
                                         " columns, the header " + std::to_string(targets.size()));
    ++frames_;
    return true;
  }

  [[noreturn]] void fail(std::string_view field, const std::string& message,
                         const std::string& hint = {}) const {
    throw error(field, message, hint);
  }
  /// @param field  a part of the row that it is about; else the whole line is meant
  [[nodiscard]] InputError error(std::string_view field, const std::string& message,
                                 const std::string& hint) const {
    const bool inside =
        !row_.empty() && field.data() >= row_.data() && field.data() <= row_.data() + row_.size();
    return InputError({{.file = file_,
                        .line = lines_.number(),
                        .column = inside ? static_cast<std::size_t>(field.data() - row_.data()) + 1
                                         : std::size_t{1},
                        .message = message,
                        .hint = hint}});
  }

  [[nodiscard]] std::vector<std::string> closing_notes() const {
    if (backwards_ == 0) return {};
    return {"time runs backwards " + std::to_string(backwards_) +
            (backwards_ == 1 ? " time" : " times") + ", first at frame " +
            std::to_string(first_backwards_) + " (line " + std::to_string(line_backwards_) + ")"};
  }

  [[nodiscard]] std::string_view row() const noexcept { return row_; }
  [[nodiscard]] std::string_view time() const noexcept { return time_; }
  [[nodiscard]] const ColumnMatch& match() const noexcept { return match_; }
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return wanted_.names; }
  [[nodiscard]] std::size_t bytes() const noexcept { return lines_.bytes(); }

 private:
  void read_names() {
    TextLines::Got got = TextLines::Got::end;
    std::optional<CsvHeader> header = read_header(lines_, got);
    row_ = lines_.line();
    if (const auto foreign = foreign_format(lines_.start()))
      throw InputError({{.file = file_, .message = foreign->what, .hint = foreign->what_to_do}});
    if (row_.find('\r') != std::string_view::npos)
      fail({}, "lines end in a carriage return alone, as on old Macs",
           "tr '\\r' '\\n' < FILE | tactile-net ... --readings -");
    check(got);
    if (!header)
      fail({}, "no header: the file is empty",
           wanted_.names.empty() ? "line 1 names the columns"
                                 : "line 1 names the columns: " + wanted_.names.front() +
                                       ", ..., " + wanted_.names.back());
    header_ = std::move(*header);
  }

  bool read_line() {
    const TextLines::Got got = lines_.next();
    row_ = lines_.line();
    check(got);
    return got == TextLines::Got::line;
  }

  void check(TextLines::Got got) const {
    if (got == TextLines::Got::failure) fail({}, "cannot be read");
    if (got == TextLines::Got::too_long)
      fail({}, "a line is longer than " + std::to_string(longest_line) + " bytes",
           "is this a CSV file?");
  }

  [[nodiscard]] std::string in_column(std::size_t field) const {
    return " (column " +
           (field < header_.names.size() ? header_.names[field].substr(0, 40)
                                         : std::to_string(field + 1)) +
           ")";
  }

  double reading(std::string_view raw, std::size_t field) {
    const std::string_view text = trimmed(raw);
    double value = 0.0;
    const FieldKind kind = read_field(text, header_.layout.may_have_decimal_comma(), value);
    if (kind == FieldKind::number) [[likely]] {
      if (header_.layout.may_have_decimal_comma()) check_decimals(raw, text, field);
      return value;
    }
    if (kind == FieldKind::missing && wanted_.accept_missing)
      return std::numeric_limits<double>::quiet_NaN();
    fail(raw, why_no_number(text, kind) + in_column(field),
         kind == FieldKind::missing ? missing_hint : std::string{});
  }

  /// "1.234" and "1,5" in one file: one of them is not what it looks like.
  void check_decimals(std::string_view raw, std::string_view text, std::size_t field) {
    const std::size_t at = text.find_first_of(".,");
    if (at == std::string_view::npos) return;
    if (decimal_ != '\0' && decimal_ != text[at])
      fail(raw,
           "'" + std::string(text.substr(0, 40)) + "' has a decimal " +
               (text[at] == ',' ? "comma, a number before it a point"
                                : "point, a number before it a comma") +
               in_column(field),
           "write all numbers in one way, without separators of thousands");
    decimal_ = text[at];
  }

  void read_time(std::string_view raw, std::size_t field) {
    const std::string_view text = trimmed(raw);
    double value = 0.0;
    const FieldKind kind = read_field(text, header_.layout.may_have_decimal_comma(), value);
    time_ = text;
    if (kind == FieldKind::number) {
      if (text.find(',') != std::string_view::npos) {
        check_decimals(raw, text, field);
        time_text_ = shortest(value);
        time_ = time_text_;
      }
      if (value < last_time_ && backwards_++ == 0) {
        first_backwards_ = frames_;
        line_backwards_ = lines_.number();
      }
      last_time_ = value;
    } else if (kind == FieldKind::missing && wanted_.accept_missing) {
      time_ = {};
    } else if (!is_moment(text)) {
      fail(raw, why_no_number(text, kind) + in_column(field),
           "a time is a number, or a date or clock time that begins with a digit");
    }
  }

  TextLines lines_;
  std::string file_;
  WantedColumns wanted_;
  CsvHeader header_;
  ColumnMatch match_;
  std::string_view row_;
  std::string_view time_;
  std::string time_text_;  // where it is not what stands in the row
  char decimal_ = '\0';    // where it may be a comma: which it is in this file
  double last_time_ = -std::numeric_limits<double>::infinity();
  std::size_t frames_ = 0;
  std::size_t backwards_ = 0, first_backwards_ = 0, line_backwards_ = 0;
};

CsvColumns csv_columns(std::istream& in, const std::string& file) {
  return CsvFrames::Reader(in, file).columns();
}

CsvFrames::CsvFrames(std::istream& in, std::string file, const WantedColumns& wanted)
    : reader_(std::make_unique<Reader>(in, std::move(file))) {
  reader_->open(wanted, nullptr);
}

CsvFrames::CsvFrames(std::istream& in, std::string file, const ChooseColumns& choose)
    : reader_(std::make_unique<Reader>(in, std::move(file))) {
  reader_->open({}, &choose);
}

CsvFrames::~CsvFrames() = default;

bool CsvFrames::next(std::span<double> values) { return reader_->next(values); }

InputError CsvFrames::refusal(const std::string& message, const std::string& hint) const {
  return reader_->error(reader_->row(), message, hint);
}

std::span<const std::string> CsvFrames::columns() const noexcept { return reader_->names(); }
bool CsvFrames::has_time() const noexcept { return reader_->match().has_time; }
std::string_view CsvFrames::time() const noexcept { return reader_->time(); }
std::span<const std::string> CsvFrames::ignored() const noexcept {
  return reader_->match().ignored;
}
std::span<const std::string> CsvFrames::opening_notes() const noexcept {
  return reader_->match().notes;
}
std::vector<std::string> CsvFrames::closing_notes() const { return reader_->closing_notes(); }
std::size_t CsvFrames::bytes_read() const noexcept { return reader_->bytes(); }

}  // namespace tactile_net::frames
