/// @file
/// Output that is either whole or not there: written under a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <set>
#include <string>
#include <string_view>

namespace tactile_net::frames {

/// One file, or standard output for "-" and for an empty path. Devices and pipes are written to
/// directly.
class OutputFile {
 public:
  /// @throw CannotCreate  the file cannot be created
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();  ///< removes what was not committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] std::ostream& stream() noexcept;

  /// Written to directly: standard output, a device, a pipe.
  [[nodiscard]] bool is_direct() const noexcept { return temporary_.empty(); }

  /// Flushes, checks, renames. @throw std::runtime_error  something was not written: a full disk
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;  // empty: written directly
  std::ofstream file_;
};

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

  /// Moves every file into place, replacing those of an earlier run, and notes what else is there.
  /// @throw CannotCreate  a folder stands where a file should
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path staging_;
};

/// Says on standard error which results a folder holds beside those just written.
void note_others(const std::filesystem::path& folder, const std::set<std::string>& written);

}  // namespace tactile_net::frames
