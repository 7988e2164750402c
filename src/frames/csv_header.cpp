#include "frames/csv_header.hpp"

#include <algorithm>
#include <utility>

#include "frames/column_names.hpp"
#include "frames/header_units.hpp"
#include "numeric/field_value.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::frames {
namespace {

using Fields = std::vector<std::string_view>;

/// Lines before the first row that are looked through.
constexpr std::size_t most_heads = 64;
constexpr std::size_t most_head_bytes = std::size_t{1} << 20;  // bytes

/// "# ", as numpy.savetxt and most programs write it, and MATLAB's "% ".
bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('%'); }

std::string_view without_mark(std::string_view comment) {
  while (!comment.empty() && (comment.front() == '#' || comment.front() == '%'))
    comment.remove_prefix(1);
  return comment;
}

/// What the fields of a line are.
struct Tally {
  std::size_t numbers = 0;
  std::size_t missing = 0;  // empty, or a word that says so
  std::size_t empty = 0;
  std::size_t texts = 0;   // but for what begins with a digit, as dates do
  std::size_t others = 0;  // the latter
  [[nodiscard]] std::size_t filled() const noexcept {
    return numbers + missing + texts + others - empty;
  }
};

Tally tally(const Fields& fields, CsvLayout layout) {
  Tally found;
  for (const std::string_view field : fields) {
    const std::string_view text = trimmed(field);
    double value = 0.0;
    const FieldKind kind = read_field(text, layout.may_have_decimal_comma(), value);
    if (text.empty()) ++found.empty;
    if (kind == FieldKind::missing)
      ++found.missing;
    else if (kind != FieldKind::text)
      ++found.numbers;
    else if (text.front() >= '0' && text.front() <= '9')
      ++found.others;
    else
      ++found.texts;
  }
  return found;
}

/// Numbers of columns, as pandas and spreadsheets write them: 0, 1, 2, ... or 1, 2, 3, ..., perhaps
/// anew for each group of columns.
///
/// @param least  how many there must be, and how many in each run: fewer could as well be readings
bool counts(const Fields& fields, std::size_t least, std::size_t least_run) {
  std::size_t numbers = 0;
  std::size_t first = 0;
  std::size_t run = 0;
  for (const std::string_view field : fields) {
    const std::string_view text = trimmed(field);
    if (text.empty() || text.front() < '0' || text.front() > '9') {
      double value = 0.0;
      if (read_field(text, false, value) == FieldKind::number) return false;
      continue;
    }
    if (numbers == 0) first = text == "1" ? 1 : 0;
    if (text != std::to_string(first + run)) {
      if (run < least_run || text != std::to_string(first)) return false;
      run = 0;
    }
    ++run;
    ++numbers;
  }
  return numbers >= least && run >= least_run;
}

/// Column numbers that are all the names there are.
bool counts(const Fields& fields, const Tally& of) {
  return of.texts + of.others > 0 ? counts(fields, 2, 2) : counts(fields, 4, 4);
}

/// A line that names columns or says something, before the first row.
struct Head {
  HeldLine line{};
  CsvLayout layout{};
  Fields fields{};  // of the line's text
  Tally of{};
  [[nodiscard]] bool is_count() const { return of.texts + of.others == 0 && counts(fields, 4, 2); }
};

/// Reads the lines before the first row, and tells which is which.
class HeaderReader {
 public:
  HeaderReader(TextLines& lines, TextLines::Got& got) : lines_(lines), got_(got) {}

  std::optional<CsvHeader> read() {
    skip_comments();
    if (got_ == TextLines::Got::end && !comment_.text.empty()) {  // names in a comment, no frame
      take_comment(layout_of(without_mark(comment_.text)));
      return std::move(header_);
    }
    if (got_ != TextLines::Got::line) return std::nullopt;
    const std::string first(lines_.line());
    const CsvLayout layout = stated_.value_or(layout_of(first));
    header_.layout = layout;
    if (begins_with_row(first, layout)) {
      header_.row_fields = fields_of(header_.rows.front().text, layout).size();
      take_comment_beside_rows();
      return std::move(header_);
    }
    if (heads_.empty()) add_head({lines_.number(), first});
    if (header_.rows.empty()) read_heads();
    choose_names();
    return std::move(header_);
  }

 private:
  void skip_comments() {
    for (got_ = lines_.next(); got_ == TextLines::Got::line; got_ = lines_.next()) {
      const std::string_view line = lines_.line();
      // Excel's own way to say what separates fields: "sep=;".
      if (lines_.number() == 1 && line.size() == 5 && line.starts_with("sep="))
        stated_ = CsvLayout{line[4]};
      else if (is_comment(line))
        comment_ = {lines_.number(), std::string(line)};
      else
        return;
    }
  }

  /// Whether the first line is a row: of numbers; of more numbers than words, if the next line has
  /// words in the same columns. What is a row is held; what is a line of names is a head.
  bool begins_with_row(const std::string& first, CsvLayout layout) {
    const HeldLine line{lines_.number(), first};
    const Fields fields = fields_of(first, layout);
    const Tally of = tally(fields, layout);
    if (counts(fields, of) || of.numbers == 0 || of.numbers <= of.texts) return false;
    if (of.texts == 0) {
      header_.rows.push_back(line);
      return true;
    }
    const Got next = next_line();
    if (next != Got::line) {
      header_.rows.push_back(line);
      return true;
    }
    const std::string second(lines_.line());
    const Fields below = fields_of(second, layout);
    bool same = below.size() == fields.size();
    for (std::size_t i = 0; same && i < fields.size(); ++i)
      same = !is_text(fields[i], layout) || is_text(below[i], layout);
    if (same) {
      header_.rows.push_back(line);
    } else {
      add_head(line);
    }
    if (same || is_row(second))
      header_.rows.push_back({lines_.number(), second});
    else
      add_head({lines_.number(), second});
    return same;
  }

  static bool is_text(std::string_view field, CsvLayout layout) {
    const Tally of = tally({field}, layout);
    return of.texts == 1;
  }

  using Got = TextLines::Got;

  Got next_line() {
    do got_ = lines_.next();
    while (got_ == Got::line && is_comment(lines_.line()));
    return got_;
  }

  void add_head(HeldLine line) {
    held_ += line.text.size();
    Head head{.line = std::move(line)};
    head.layout = stated_.value_or(layout_of(head.line.text));
    heads_.push_back(std::move(head));
    Head& held = heads_.back();
    held.fields = names_of(held.line.text, held.layout);
    held.of = tally(held.fields, held.layout);
  }

  /// Whether a line behind heads is a row: nothing but numbers and gaps; more numbers than words;
  /// or some numbers in as many fields as a head without numbers has.
  [[nodiscard]] bool is_row(const std::string& text) const {
    for (const CsvLayout layout : {heads_.front().layout, stated_.value_or(layout_of(text))}) {
      const Fields fields = fields_of(text, layout);
      const Tally of = tally(fields, layout);
      if (counts(fields, 8, 4) || is_numbers_of_groups(fields)) return false;
      if (of.texts == 0 && (of.numbers > 0 || of.others == 0)) return true;
      if (of.numbers > of.texts) return true;
      const bool may_be =
          of.numbers + of.others > 0 && (fields.size() > 2 || !is_text(fields[0], layout));
      if (may_be && std::any_of(heads_.begin(), heads_.end(), [&](const Head& head) {
            return head.of.numbers == 0 && head.fields.size() == fields.size();
          }))
        return true;
    }
    return false;
  }

  /// "time,stress_x,,,shear_xy,," and below it ",0,1,2,0,1,2".
  [[nodiscard]] bool is_numbers_of_groups(const Fields& fields) const {
    const Head& above = heads_.back();
    return above.fields.size() == fields.size() && above.of.numbers == 0 &&
           2 * above.of.empty >= fields.size() && counts(fields, 4, 2);
  }

  void read_heads() {
    while (heads_.size() < most_heads && held_ < most_head_bytes && next_line() == Got::line) {
      const std::string text(lines_.line());
      if (is_row(text)) {
        header_.rows.push_back({lines_.number(), text});
        return;
      }
      add_head({lines_.number(), text});
    }
  }

  /// How many fields the first row has, cut as the head's line is; 0: there is no row.
  [[nodiscard]] std::size_t row_fields(CsvLayout layout) const {
    return header_.rows.empty() ? 0 : fields_of(header_.rows.front().text, layout).size();
  }

  /// The same, cut as the row itself looks.
  [[nodiscard]] std::size_t row_fields() const {
    return header_.rows.empty()
               ? 0
               : row_fields(stated_.value_or(layout_of(header_.rows.front().text)));
  }

  void choose_names() {
    std::optional<std::size_t> place;
    for (std::size_t k = 0; k < heads_.size(); ++k) {
      const Head& head = heads_[k];
      if (!header_.rows.empty() && head.fields.size() != row_fields(head.layout)) continue;
      if (head.is_count() && k > 0) continue;
      if (!place || head.of.filled() > heads_[*place].of.filled()) place = k;
    }
    if (!place) {  // the names are fewer or more than the row's fields
      const auto longest = std::max_element(
          heads_.begin(), heads_.end(),
          [](const Head& a, const Head& b) { return a.fields.size() < b.fields.size(); });
      if (heads_.size() > 1 && 2 * longest->fields.size() < row_fields()) return without_names();
      place = static_cast<std::size_t>(longest - heads_.begin());
    }
    const Head& chosen = heads_[*place];
    say_before(*place, "the names");
    header_.layout = chosen.layout;
    header_.line = chosen.line;
    set_names(chosen.fields, chosen.line.text);
    header_.row_fields = row_fields(chosen.layout);
    for (std::size_t k = *place + 1; k < heads_.size(); ++k) read_below(heads_[k]);
    if (words_ > 1)
      header_.notes.push_back(std::to_string(words_ - 1) +
                              " more such lines before the first frame");
  }

  void without_names() {
    say_before(heads_.size(), "the first line of numbers");
    header_.layout = stated_.value_or(layout_of(header_.rows.front().text));
    header_.row_fields = row_fields(header_.layout);
  }

  void say_before(std::size_t heads, const std::string& what) {
    if (heads == 0) return;
    const std::string first = std::to_string(heads_.front().line.number);
    const std::string last = std::to_string(heads_[heads - 1].line.number);
    header_.notes.push_back(
        (heads == 1
             ? "line " + first + " comes before " + what + ", and is not a frame"
             : "lines " + first + " to " + last + " come before " + what + ", and are no frames") +
        ": '" + heads_.front().line.text.substr(0, 40) + "'");
  }

  /// A line between the names and the first row.
  void read_below(const Head& head) {
    const std::string line = "line " + std::to_string(head.line.number);
    const bool fits = head.fields.size() == header_.names.size();
    if (fits && head.is_count()) {
      const auto empty = std::count(header_.names.begin(), header_.names.end(), "");
      if (2 * empty >= std::ssize(header_.names)) number_groups(head);
      header_.notes.push_back(line + " numbers the columns, and is not a frame");
      return;
    }
    if (fits && units_in(head) > 0 && 2 * units_in(head) >= head.of.filled()) {
      for (std::size_t k = 0; k < header_.names.size(); ++k) {
        const std::string unit(without_brackets(trimmed(head.fields[k])));
        if (!unit.empty() && column_name(header_.names[k]).unit.empty())
          header_.names[k] += " [" + unit + "]";
      }
      header_.notes.push_back(line + " gives the units of the columns, and is not a frame");
      return;
    }
    if (words_++ == 0)
      header_.notes.push_back(line + " holds words, and is not a frame: '" +
                              head.line.text.substr(0, 40) + "'");
  }

  static std::string_view without_brackets(std::string_view text) {
    if (text.size() > 2 && ((text.front() == '[' && text.back() == ']') ||
                            (text.front() == '(' && text.back() == ')')))
      return text.substr(1, text.size() - 2);
    return text;
  }

  static std::size_t units_in(const Head& head) {
    return static_cast<std::size_t>(
        std::count_if(head.fields.begin(), head.fields.end(), [](std::string_view field) {
          const std::string_view text = without_brackets(trimmed(field));
          return !text.empty() && text != "-" && names_unit(text);
        }));
  }

  /// A name stands over the first column of its group.
  void number_groups(const Head& head) {
    std::string group;
    for (std::size_t k = 0; k < header_.names.size(); ++k) {
      if (!header_.names[k].empty()) group = header_.names[k];
      if (const std::string_view number = trimmed(head.fields[k]); !number.empty())
        header_.names[k] = group + "_" + std::string(number);
    }
  }

  /// @param names  parts of `line`
  void set_names(const Fields& names, const std::string& line) {
    for (const std::string_view name : names) {
      header_.names.emplace_back(trimmed(name));
      header_.at.push_back(static_cast<std::size_t>(name.data() - line.data()));
    }
  }

  void take_comment(CsvLayout layout) {
    set_names(names_of(without_mark(comment_.text), layout), comment_.text);
    header_.line = comment_;
  }

  /// The last comment before rows has the names, if it has as many.
  void take_comment_beside_rows() {
    const std::string_view part = without_mark(comment_.text);
    const CsvLayout layout = layout_of(part);
    const Fields names = names_of(part, layout);
    const Tally of = tally(names, layout);
    if (names.size() == header_.row_fields && (of.texts > 0 || counts(names, of)))
      take_comment(layout);
  }

  TextLines& lines_;
  TextLines::Got& got_;
  CsvHeader header_{};
  HeldLine comment_{};
  std::optional<CsvLayout> stated_{};
  std::deque<Head> heads_{};
  std::size_t held_ = 0;   // bytes of them
  std::size_t words_ = 0;  // lines between the names and the first row that are neither
};

}  // namespace

std::optional<CsvHeader> read_header(TextLines& lines, TextLines::Got& got) {
  return HeaderReader(lines, got).read();
}

}  // namespace tactile_net::frames
