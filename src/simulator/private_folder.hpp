/// @file
/// The folder in which one deck is run.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

#include "tactile_net/system/file_lock.hpp"
#include "tactile_net/system/leftovers.hpp"

namespace tactile_net {

/// A temporary folder that only this user can read; removed at the end, a sudden one too. What a
/// process that was killed has left is removed by the next one.
class PrivateFolder {
 public:
  /// In the system's temporary folder (TMPDIR). @throw std::runtime_error  it cannot be made: where
  PrivateFolder();
  /// In a folder that lives longer. @throw std::runtime_error  it cannot be made
  explicit PrivateFolder(const std::filesystem::path& in);
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  /// Moves the files of these names into a folder that stays, for people to read; all else goes.
  /// @return that folder
  [[nodiscard]] std::filesystem::path keep(std::initializer_list<std::string_view> names) const;

 private:
  std::filesystem::path path_;
  Leftover leftover_;
  FileLock lock_;
};

/// Removes the private folders of processes that are gone: those whose lock is free. The first
/// private folder of a process does so.
///
/// @param temporary  the folder that they are in
void sweep_private_folders(const std::filesystem::path& temporary);

/// @throw std::runtime_error  not all of it could be written: which file, and why
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace tactile_net
