/// @file
/// What a worker has found, on disk as it finds it, and what all journals of a sweep hold together.
///
/// A journal is a file of one writer. Its first line says of which study it is, its second names
/// the columns; then whole lines are appended, each "I/N," and a row: the I-th of N of its point.
/// Those of one point go in one write. Nothing is ever changed, no file is shared, so that any file
/// system will do.
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

/// What begins a journal, and what a sweep's journals have in common.
struct JournalHead {
  std::string version{};  ///< of the library
  std::string hash{};     ///< Study::hash
  std::size_t points = 0;
  std::string title{};  ///< of the study, or its file
  std::vector<std::string> axes{};
  std::vector<Kept> keep{};
  SweepUnits units{};

  bool operator==(const JournalHead&) const = default;
};

[[nodiscard]] JournalHead head_of(const Study& study);

/// The two lines, with their ends.
[[nodiscard]] std::string text(const JournalHead& head);

/// The lines of one point, with their ends.
[[nodiscard]] std::string lines(const std::vector<Row>& rows, const std::vector<Kept>& keep);

/// The line that stands for a point whose workers died: any answer counts more.
[[nodiscard]] std::string death_line(const Row& row, const std::vector<Kept>& keep);

/// The journals in a folder and in the folders in it, by name.
/// @throw InputError  there is no such folder
[[nodiscard]] std::vector<std::filesystem::path> journals_in(const std::filesystem::path& folder);

/// Cuts off what is no whole line at a journal's end; a head that is not whole goes too. Only for
/// who holds the lock of its folder. @throw std::runtime_error  the file cannot be cut
void drop_torn_line(const std::filesystem::path& journal);

/// The rows of a sweep, from as many journals as there are.
class Rows {
 public:
  /// @param head  of the study; others' journals are refused
  explicit Rows(JournalHead head) : head_(std::move(head)) {}

  /// Adds what a journal holds up to its last whole line.
  ///
  /// @throw InputError  it is of another study or another version of the library; a line is no row;
  ///                    it has another answer than an earlier journal
  void add(const std::filesystem::path& journal);

  [[nodiscard]] const JournalHead& head() const noexcept { return head_; }
  /// How many points have all their rows.
  [[nodiscard]] std::size_t done() const noexcept { return points_.size(); }
  [[nodiscard]] bool has(std::size_t index) const { return points_.contains(index); }
  /// The rows of each point, as CSV.
  [[nodiscard]] const std::map<std::size_t, std::vector<std::string>>& points() const noexcept {
    return points_;
  }

 private:
  JournalHead head_;
  std::map<std::size_t, std::vector<std::string>> points_;
  std::map<std::size_t, std::string> deaths_;  // of points_, those that are no answers
};

/// The head of a journal. Nothing: its writer was stopped before it was whole.
/// @throw InputError  it is no journal
[[nodiscard]] std::optional<JournalHead> read_head(const std::filesystem::path& journal);

}  // namespace tactile_net::sweep
