#include "scene/calibration_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "scene/document.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What stands before the separator; the rest stays in `text`.
std::string_view cut(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  const auto separators = std::count(line.begin(), line.end(), ',');
  for (std::ptrdiff_t i = 0; i <= separators; ++i) fields.push_back(trimmed(cut(line, ',')));
  return fields;
}

class Reader {
 public:
  Reader(std::span<const std::string_view> known, std::span<const std::string> readings)
      : known_(known), readings_(readings) {}

  CalibrationColumns read(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      const std::string_view line = trimmed(cut(text, '\n'));
      if (line.empty() || line.front() == '#') continue;
      if (names_.empty())
        read_header(fields_of(line));
      else
        read_row(fields_of(line));
    }
    if (rows_ != readings_.size())
      throw std::runtime_error("it has " + std::to_string(rows_) + " rows, the array " +
                               std::to_string(readings_.size()) + " readings: one row each");
    return std::move(columns_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
  }

  void read_header(const std::vector<std::string_view>& names) {
    for (const std::string_view name : names) {
      const bool is_known =
          name == reading || std::find(known_.begin(), known_.end(), name) != known_.end();
      if (!is_known) {
        std::string all(reading);
        for (const std::string_view one : known_) all += ", " + std::string(one);
        fail("a column has another name than " + all);
      }
      if (std::count(names.begin(), names.end(), name) > 1) fail("a column stands there twice");
      names_.emplace_back(name);
      if (name != reading) columns_[names_.back()] = {};
    }
  }

  void read_row(const std::vector<std::string_view>& fields) {
    if (fields.size() != names_.size())
      fail("it has " + std::to_string(fields.size()) + " fields, the header " +
           std::to_string(names_.size()));
    if (rows_ == readings_.size()) fail("there is no reading left for this row");
    for (std::size_t i = 0; i < fields.size(); ++i) {
      double number = 0.0;
      if (names_[i] == reading) {
        if (fields[i] != readings_[rows_]) fail("this row is that of " + readings_[rows_]);
      } else if (!read_number(fields[i], number) || !std::isfinite(number)) {
        fail(names_[i] + " is not a finite number");
      } else {
        columns_[names_[i]].push_back(number);
      }
    }
    ++rows_;
  }

  static constexpr std::string_view reading = "reading";
  std::span<const std::string_view> known_;
  std::span<const std::string> readings_;
  std::vector<std::string> names_{};
  CalibrationColumns columns_{};
  std::size_t line_ = 0;
  std::size_t rows_ = 0;
};

std::string text_of(const std::filesystem::path& path) {
  try {
    return bounded_text(path, largest_file, "");
  } catch (const InputError& error) {
    throw std::runtime_error(error.diagnostics().front().message);
  }
}

}  // namespace

CalibrationColumns read_calibration_file(const std::filesystem::path& path,
                                         std::span<const std::string_view> known,
                                         std::span<const std::string> readings) {
  const std::string text = text_of(path);
  return Reader(known, readings).read(without_byte_order_mark(text));
}

}  // namespace tactile_net
