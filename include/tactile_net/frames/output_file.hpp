/// @file
/// Output that is either whole or not there: written under a temporary name, then renamed. A file
/// that is replaced hands on who may read and write it. Nothing is left of what was not: at a
/// signal, and of a killed run once the next one writes there.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/frames/cannot_create.hpp"

namespace tactile_net::frames {

class CheckedFile;
class FolderLock;
class Partial;

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
  [[nodiscard]] bool is_direct() const noexcept;

  /// Flushes, checks, renames.
  ///
  /// @throw std::runtime_error  something was not written: which file, and why ("no space left on
  ///                            device"); writing to `stream` throws it too
  void commit();

  /// As `commit`, under another name that says that there should be more: NAME.partial. What
  /// stands under the name itself stays.
  ///
  /// @return that name; empty where it was written to directly
  /// @throw as `commit`
  std::filesystem::path commit_partial();

 private:
  std::filesystem::path path_;
  std::ostream* standard_output_;                        // null: `file_` is written to
  std::optional<std::filesystem::perms> permissions_{};  // of the file that is replaced
  std::unique_ptr<CheckedFile> file_;
  std::unique_ptr<Partial> partial_;  // after `file_`: goes before it
};

/// Writes a file as a whole. @throw CannotCreate, std::runtime_error  as `OutputFile`
void write_file(const std::filesystem::path& path, std::string_view content);

/// What becomes of files that stand where results go.
enum class Existing {
  replaced,  ///< as those of an earlier run
  kept,      ///< they are somebody's own: nothing is written then
};

/// @throw CannotCreate  a file stands there, and is to be kept
void check_replaceable(const std::filesystem::path& path, Existing existing);

/// A folder of result files that appear together.
class OutputFolder {
 public:
  /// Makes a staging folder beside (or in) `path`, so that a place that cannot be written to is
  /// known before anything is computed. @throw CannotCreate  also while another run writes there
  explicit OutputFolder(const std::filesystem::path& path, Existing existing = Existing::replaced);
  ~OutputFolder();  ///< removes what was not committed
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// @throw std::runtime_error  not written: a full disk
  void write(std::string_view name, std::string_view content) const;

  /// Where a file that is too long for one text is to be written, before `commit`.
  [[nodiscard]] std::filesystem::path place(std::string_view name) const;

  /// Moves every file into place.
  ///
  /// @return what else is there, as `other_results`
  /// @throw CannotCreate  a folder stands where a file should, or a file that is to be kept
  [[nodiscard]] std::vector<std::string> commit();

 private:
  std::filesystem::path path_;
  Existing existing_;
  std::unique_ptr<FolderLock> lock_;
  std::unique_ptr<Partial> staging_;  // after the lock: goes before it
};

/// The results (CSV, SVG, decks) that a folder holds beside those just written, sorted.
[[nodiscard]] std::vector<std::string> other_results(const std::filesystem::path& folder,
                                                     const std::set<std::string>& written);

}  // namespace tactile_net::frames
