#include "tactile_net/frames/csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "frames/column_match.hpp"
#include "frames/csv_header.hpp"
#include "frames/foreign_format.hpp"
#include "frames/missing_hint.hpp"
#include "frames/text_lines.hpp"
#include "numeric/field_value.hpp"
#include "tactile_net/frames/frame_clock.hpp"
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
        throw InputError({{.file = file_,
                           .line = header_.rows.front().number,
                           .column = 1,
                           .message = "there is no header: the first line holds numbers",
                           .hint = "line 1 names the columns"}});
      wanted_.names = (*choose)(header_.names);
    }
    wanted_.unread.resize(wanted_.names.size());
    try {
      match_ = header_.names.empty() ? match_unnamed(header_.row_fields, wanted_)
                                     : match_columns(header_.names, wanted_);
    } catch (const NoMatch& no) {
      const std::size_t at = no.field < header_.at.size() ? header_.at[no.field] : 0;
      const bool named = !header_.names.empty();
      throw InputError({{.file = file_,
                         .line = named ? header_.line.number : header_.rows.front().number,
                         .column = at + 1,
                         .message = no.what(),
                         .hint = no.hint + (named ? ""
                                                  : decimal_commas(header_.rows.front().text,
                                                                   wanted_.names.size()))}});
    }
    clock_ = FrameClock(match_.time_unit);
    match_.notes.insert(match_.notes.begin(), header_.notes.begin(), header_.notes.end());
  }

  CsvColumns columns() {
    read_names();
    return {header_.names, header_.names.empty() ? header_.row_fields : header_.names.size()};
  }

  bool next(std::span<double> values) {
    if (!read_line()) return false;
    const CsvLayout layout = header_.layout;
    const std::vector<std::ptrdiff_t>& targets = match_.target;
    std::string_view rest = row_;
    std::size_t fields = 0;
    TimeField time;
    for (bool more = true; more; ++fields) {
      const std::string_view raw = take_field(rest, more, layout);
      if (fields >= targets.size())
        fail(raw, "more than the header's " + std::to_string(targets.size()) + " columns",
             decimal_commas(row_, targets.size()));
      const std::ptrdiff_t target = targets[fields];
      if (target >= 0) {
        const auto index = static_cast<std::size_t>(target);
        values[index] = wanted_.unread[index] ? 0.0 : reading(raw, fields);
      } else if (target == ColumnMatch::time_field) {
        time.whole = {raw, fields};
      } else if (target == ColumnMatch::nanoseconds_field) {
        time.nanoseconds = {raw, fields};
      }
    }
    if (fields < targets.size())
      fail(row_.substr(row_.size()), "the row has " + std::to_string(fields) +
                                         " columns, the header " + std::to_string(targets.size()));
    if (match_.has_time) read_time(time);
    for (std::size_t i = 0; i < match_.factors.size(); ++i)
      if (values[i] = match_.factors[i].to_si(values[i]); std::isinf(values[i]))
        fail(row_,
             "'" + wanted_.names[i] + "' is beyond the range of a double in the scene's unit");
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
                        .line = row_number_,
                        .column = inside ? static_cast<std::size_t>(field.data() - row_.data()) + 1
                                         : std::size_t{1},
                        .message = message,
                        .hint = hint}});
  }

  [[nodiscard]] std::vector<std::string> closing_notes() const {
    std::vector<std::string> notes;
    if (backwards_ > 0)
      notes.push_back("time runs backwards " + std::to_string(backwards_) +
                      (backwards_ == 1 ? " time" : " times") + ", first at frame " +
                      std::to_string(first_backwards_) + " (line " +
                      std::to_string(line_backwards_) + ")");
    if (rollovers_ > 0)
      notes.push_back(
          "a counter of 32 bits begins anew after 4294967295 = 2^32 - 1 there: add 2^32 to all "
          "later times");
    return notes;
  }

  [[nodiscard]] const FrameClock& clock() const noexcept { return clock_; }

  [[nodiscard]] std::string_view row() const noexcept { return row_; }
  [[nodiscard]] std::string_view time() const noexcept { return time_; }
  [[nodiscard]] const ColumnMatch& match() const noexcept { return match_; }
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return wanted_.names; }
  [[nodiscard]] std::size_t bytes() const noexcept { return lines_.bytes(); }

 private:
  struct Field {
    std::string_view raw{};
    std::size_t place = 0;
  };
  struct TimeField {
    Field whole{};
    std::optional<Field> nanoseconds{};  // of a second: the time is in two columns
  };

  /// What is said of a row with twice as many fields as there are columns, all whole numbers: the
  /// second of each pair are decimals. Else nothing.
  [[nodiscard]] std::string decimal_commas(std::string_view row, std::size_t columns) const {
    if (header_.layout.separator != ',') return {};
    const auto fields = fields_of(row, header_.layout);
    if (fields.size() != 2 * columns && fields.size() != 2 * (columns + 1)) return {};
    const auto is_digits = [](std::string_view text) {
      return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    };
    for (std::size_t i = 0; i < fields.size(); ++i) {
      std::string_view text = trimmed(fields[i]);
      if (i % 2 == 0 && (text.starts_with('-') || text.starts_with('+'))) text.remove_prefix(1);
      if (!is_digits(text)) return {};
    }
    return std::string(header_.names.empty() ? "; or these" : "these") +
           " are decimal commas between commas: write the table with semicolons between fields, or "
           "with decimal points";
  }

  void read_names() {
    TextLines::Got got = TextLines::Got::end;
    std::optional<CsvHeader> header = read_header(lines_, got);
    row_ = lines_.line();
    row_number_ = lines_.number();
    if (const auto foreign = foreign_format(lines_.start()))
      throw InputError({{.file = file_, .message = foreign->what, .hint = foreign->what_to_do}});
    if (row_.find('\r') != std::string_view::npos ||
        (header && header->line.text.find('\r') != std::string::npos))
      fail({}, "lines end in a carriage return alone, as on old Macs",
           "convert them: tr '\\r' '\\n' < FILE > readings.csv");
    check(got);
    if (!header)
      fail({}, "no header: the file is empty",
           wanted_.names.empty() ? "line 1 names the columns"
                                 : "line 1 names the columns: " + wanted_.names.front() +
                                       ", ..., " + wanted_.names.back());
    header_ = std::move(*header);
  }

  bool read_line() {
    if (!header_.rows.empty()) {
      held_ = std::move(header_.rows.front());
      header_.rows.pop_front();
      row_ = held_.text;
      row_number_ = held_.number;
      return true;
    }
    const TextLines::Got got = lines_.next();
    row_ = lines_.line();
    row_number_ = lines_.number();
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
      return wanted_.keep_infinities && std::isinf(value)
                 ? value
                 : std::numeric_limits<double>::quiet_NaN();
    fail(raw, why_no_number(text, kind) + in_column(field),
         kind == FieldKind::missing ? missing_hint() : how_to_write(text));
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

  void read_time(const TimeField& fields) {
    const auto [raw, place] = fields.whole;
    const std::string_view text = trimmed(raw);
    double value = 0.0;
    const FieldKind kind = read_field(text, header_.layout.may_have_decimal_comma(), value);
    time_ = text;
    clock_.skip();
    if (kind == FieldKind::number) {
      if (const std::size_t comma = text.find(','); comma != std::string_view::npos) {
        check_decimals(raw, text, place);
        time_text_ = text;
        time_text_[comma] = '.';
        time_ = time_text_;
      }
      if (fields.nanoseconds) value = joined(raw, place, *fields.nanoseconds);
      take_time(value);
    } else if (kind == FieldKind::missing && wanted_.accept_missing) {
      time_ = {};
    } else if (!is_moment(text)) {
      fail(raw, why_no_number(text, kind) + in_column(place),
           "a time is a number, or a date or clock time that begins with a digit");
    }
  }

  /// "1712345678" and "50000000" are 1712345678.050000000.
  double joined(std::string_view raw, std::size_t place, const Field& nanoseconds) {
    constexpr std::size_t digits = 9;
    const std::string_view part = trimmed(nanoseconds.raw);
    if (!whole_number(time_))
      fail(raw,
           "'" + std::string(time_.substr(0, 40)) + "' is not a whole number of seconds" +
               in_column(place),
           "nanoseconds stand in a column of their own here");
    if (!whole_number(part) || part.size() > digits)
      fail(nanoseconds.raw, "'" + std::string(part.substr(0, 40)) +
                                "' is not a number of nanoseconds below a second" +
                                in_column(nanoseconds.place));
    time_text_ = std::string(time_) + '.' + std::string(digits - part.size(), '0').append(part);
    time_ = time_text_;
    double value = 0.0;
    static_cast<void>(read_number(time_, value));
    return value;
  }

  void take_time(double value) {
    if (const auto last = clock_.last(); last && value < *last) {
      if (backwards_++ == 0) {
        first_backwards_ = frames_;
        line_backwards_ = row_number_;
      }
      if (begins_anew(*last, value)) ++rollovers_;
    }
    clock_.add(value);
  }

  /// micros() and millis() of microcontrollers do, after 71.6 minutes and 49.7 days.
  static bool begins_anew(double last, double next) {
    constexpr double end = 4294967296.0;
    return last < end && last > 15.0 / 16.0 * end && next >= 0.0 && next < end / 16.0;
  }

  TextLines lines_;
  std::string file_;
  WantedColumns wanted_;
  CsvHeader header_;
  ColumnMatch match_;
  std::string_view row_;
  std::size_t row_number_ = 0;
  HeldLine held_;  // the row, where it was read with the header
  std::string_view time_;
  FrameClock clock_;
  std::string time_text_;  // where it is not what stands in the row
  char decimal_ = '\0';    // where it may be a comma: which it is in this file
  std::size_t frames_ = 0;
  std::size_t backwards_ = 0, first_backwards_ = 0, line_backwards_ = 0;
  std::size_t rollovers_ = 0;
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
std::optional<double> CsvFrames::seconds() const { return reader_->clock().seconds(); }
bool CsvFrames::time_unit_known() const noexcept { return reader_->clock().unit_known(); }
std::span<const std::string> CsvFrames::ignored() const noexcept {
  return reader_->match().ignored;
}
std::span<const std::string> CsvFrames::opening_notes() const noexcept {
  return reader_->match().notes;
}
std::vector<std::string> CsvFrames::closing_notes() const { return reader_->closing_notes(); }
std::size_t CsvFrames::bytes_read() const noexcept { return reader_->bytes(); }

}  // namespace tactile_net::frames
