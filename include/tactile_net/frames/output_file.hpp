/// @file
/// Output that is either whole or not there: written under a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::frames {

/// An output cannot be created where the user asked for it.
class CannotCreate : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One file, or standard output for "-" and for an empty path. Devices and pipes are written to
/// directly.
class OutputFile {
 public:
  /// @param standard_output  must live as long as this; null: the path is a file's whatever it is
  /// @throw CannotCreate  the file cannot be created
  explicit OutputFile(const std::filesystem::path& path, std::ostream* standard_output = nullptr);
  ~OutputFile();  ///< removes what was not committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] std::ostream& stream() noexcept;

  /// Written to directly: standard output, a device, a pipe.
  [[nodiscard]] bool is_direct() const noexcept { return temporary_.empty(); }

  /// Flushes, checks, renames. @throw std::runtime_error  something was not written: a full disk
  void commit();

  /// As `commit`, under another name that says that there should be more: NAME.partial. What
  /// stands under the name itself stays.
  ///
  /// @return that name; empty where it was written to directly
  /// @throw as `commit`
  std::filesystem::path commit_partial();

 private:
  std::filesystem::path path_;
  std::ostream* standard_output_;    // null: `file_` is written to
  std::filesystem::path temporary_;  // empty: written directly
  std::ofstream file_;
};

/// Writes a file as a whole. @throw CannotCreate, std::runtime_error  as `OutputFile`
void write_file(const std::filesystem::path& path, std::string_view content);

/// A folder of result files that appear together.
class OutputFolder {
 public:
  /// Makes a staging folder beside (or in) `path`, so that a place that cannot be written to is
  /// known before anything is computed. @throw CannotCreate
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();  ///< removes what was not committed
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// @throw std::runtime_error  not written: a full disk
  void write(std::string_view name, std::string_view content) const;

  /// Where a file that is too long for one text is to be written, before `commit`.
  [[nodiscard]] std::filesystem::path place(std::string_view name) const { return staging_ / name; }

  /// Moves every file into place, replacing those of an earlier run.
  ///
  /// @return what else is there, as `other_results`
  /// @throw CannotCreate  a folder stands where a file should
  [[nodiscard]] std::vector<std::string> commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path staging_;
};

/// The results (CSV, SVG, decks) that a folder holds beside those just written, sorted.
[[nodiscard]] std::vector<std::string> other_results(const std::filesystem::path& folder,
                                                     const std::set<std::string>& written);

}  // namespace tactile_net::frames
