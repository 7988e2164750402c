/// @file
/// The file of rows that a sweep writes, and what several such files of one study hold together.
///
/// Its first line says of which study it is, its second names the columns; then whole lines are
/// appended, each "I/N," and a row: the I-th of N of its point. Those of one point go in one write.
/// Nothing that is written changes, so a file that was cut anywhere lacks points and no more.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/sweep/row.hpp"

namespace tactile_net::sweep {

/// What begins a file of rows.
struct RowsHead {
  std::string version{};  ///< of the library
  std::string study{};    ///< Study::hash
  std::size_t points = 0;
  std::string title{};  ///< of the study, or its file
  std::vector<std::string> axes{};
  std::vector<Kept> keep{};
  SweepUnits units{};
};

[[nodiscard]] RowsHead head_of(const Study& study);

/// The two lines, with their ends.
[[nodiscard]] std::string text(const RowsHead& head);

/// The lines of one point, with their ends.
[[nodiscard]] std::string lines(const std::vector<Row>& rows, const std::vector<Kept>& keep);

/// The head of a file. Nothing: its sweep was stopped before it was whole.
/// @throw InputError  it cannot be read, or is no file of rows
[[nodiscard]] std::optional<RowsHead> read_head(const std::filesystem::path& file);

/// The rows of a sweep, from as many files as there are.
class Rows {
 public:
  /// @param head  of the study; others' files are refused
  explicit Rows(RowsHead head) : head_(std::move(head)) {}

  /// Adds the points that a file holds whole.
  ///
  /// @throw InputError  it cannot be read, or is no file of rows; it is of another study or another
  ///                    version of the library; a line is no row; a point has another answer than
  ///                    before
  void add(const std::filesystem::path& file);

  [[nodiscard]] const RowsHead& head() const noexcept { return head_; }
  [[nodiscard]] bool has(std::size_t index) const { return points_.contains(index); }
  /// The rows of each point that has all of them, as CSV.
  [[nodiscard]] const std::map<std::size_t, std::vector<std::string>>& points() const noexcept {
    return points_;
  }

 private:
  friend class RowsFile;
  /// @return  the length up to the last whole point
  std::size_t add(std::string_view content, const std::filesystem::path& file);

  RowsHead head_;
  std::map<std::size_t, std::vector<std::string>> points_;
};

/// A file of rows that points are appended to. One process at a time has it, and loses it with its
/// end, however that comes.
class RowsFile {
 public:
  /// Makes the file, or goes on with it: what follows its last whole point is cut off.
  ///
  /// @throw InputError            as `Rows::add`; the file stays as it is
  /// @throw frames::CannotCreate  it cannot be written to; another sweep has it
  /// @throw std::runtime_error    the head could not be written: a full disk
  RowsFile(const Study& study, std::filesystem::path path);
  ~RowsFile() { close(); }
  RowsFile(const RowsFile&) = delete;
  RowsFile& operator=(const RowsFile&) = delete;

  /// Lets others write into it. Nothing can be appended then.
  void close() noexcept;

  /// What it held when it was opened.
  [[nodiscard]] const Rows& rows() const noexcept { return rows_; }

  /// @param lines  of whole points, as `lines` makes them
  /// @throw std::runtime_error  they could not be written: a full disk; none of them is there then
  void append(std::string_view lines);

 private:
  std::filesystem::path path_;
  Rows rows_;
  int file_ = -1;
  std::size_t size_ = 0;
};

}  // namespace tactile_net::sweep
