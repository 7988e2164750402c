/// @file
/// The folder in which one deck is run.
#pragma once

#include <filesystem>
#include <string_view>

namespace tactile_net {

/// A temporary folder that only this user can read; removed unless it is kept.
class PrivateFolder {
 public:
  /// @throw std::runtime_error  it cannot be made
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  void keep() noexcept { kept_ = true; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

/// @throw std::runtime_error  not all of it could be written
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace tactile_net
