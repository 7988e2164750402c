/// @file
/// Frames as CSV: a header, then one frame a row. Numbers are the same in every locale.
///
/// What is written has commas and decimal points. What is read may also have fields separated by
/// semicolons, tabs or blanks (decimal commas then too), a byte order mark, lines of comment ("#")
/// before the header or with it, words of a logger before it, units below it, and names in another
/// spelling; see docs/results.md.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

struct CsvColumns;

/// Reads CSV.
class CsvFrames final : public FrameSource {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  // bytes

  /// Which columns to read, given the names in the file's header.
  using ChooseColumns =
      std::function<std::vector<std::string>(std::span<const std::string> header)>;

  /// Reads the header; where there is none, the first row.
  ///
  /// @param in    must live as long as this
  /// @param file  name for messages
  /// @throw InputError  there is no header, a column is missing or stands twice, it is not text
  /// @throw std::invalid_argument  `wanted.places` does not fit the file
  CsvFrames(std::istream& in, std::string file, const WantedColumns& wanted);

  /// The same where the columns depend on what the file has, which must have a header.
  CsvFrames(std::istream& in, std::string file, const ChooseColumns& choose);
  ~CsvFrames() override;

  /// As `FrameSource`; rows that are empty are skipped. @throw InputError  a row has too few or too
  /// many fields too: the text names file, line and column
  [[nodiscard]] bool next(std::span<double> values) override;
  [[nodiscard]] InputError refusal(const std::string& message,
                                   const std::string& hint) const override;

  [[nodiscard]] std::span<const std::string> columns() const noexcept override;
  [[nodiscard]] bool has_time() const noexcept override;
  [[nodiscard]] std::string_view time() const noexcept override;
  [[nodiscard]] std::optional<double> seconds() const override;
  [[nodiscard]] bool time_unit_known() const noexcept override;
  [[nodiscard]] std::span<const std::string> ignored() const noexcept override;
  [[nodiscard]] std::span<const std::string> opening_notes() const noexcept override;
  [[nodiscard]] std::vector<std::string> closing_notes() const override;
  [[nodiscard]] std::size_t bytes_read() const noexcept override;

 private:
  friend CsvColumns csv_columns(std::istream& in, const std::string& file);
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// What the header of a file says.
struct CsvColumns {
  std::vector<std::string> names{};  ///< none: there is no header
  std::size_t count = 0;             ///< of a row
};

/// @throw InputError  as the constructor of `CsvFrames`
[[nodiscard]] CsvColumns csv_columns(std::istream& in, const std::string& file);

/// Writes CSV, `t` first if `with_time`; a block at a time.
class CsvSink final : public FrameSink {
 public:
  CsvSink(std::ostream& out, std::span<const std::string> columns, bool with_time);
  void add(std::string_view time, std::span<const double> values) override;
  /// A row whose last column is a word.
  void add(std::string_view time, std::span<const double> values, std::string_view word);
  void flush() override;

 private:
  void flush_block();

  std::ostream& out_;
  bool with_time_;
  std::string text_;
};

/// The names, and `t` first if `with_time`, separated by commas, and a newline.
void append_header(std::string& out, std::span<const std::string> columns, bool with_time);

/// Values separated by commas, shortest exact text, NaN as an empty field, and a newline.
void append_row(std::string& out, std::span<const double> values);

}  // namespace tactile_net::frames
