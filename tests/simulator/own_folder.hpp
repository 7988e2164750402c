/// @file
/// A folder of a test's own for temporary ones (TMPDIR), removed with all it holds.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tactile_net {

class OwnFolder {
 public:
  OwnFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tactile-net-own-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
    std::filesystem::create_directory(path_ / "tmp");
    ::setenv("TMPDIR", (path_ / "tmp").c_str(), 1);
  }
  ~OwnFolder() {
    ::unsetenv("TMPDIR");
    std::filesystem::remove_all(path_);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  /// A path in it that no temporary folder has.
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  /// How many temporary folders are there.
  [[nodiscard]] std::ptrdiff_t left() const {
    return std::distance(std::filesystem::directory_iterator(path_ / "tmp"), {});
  }
  [[nodiscard]] std::filesystem::path tmp() const { return path_ / "tmp"; }

 private:
  std::filesystem::path path_;
};

/// Whether the process is there and does not only wait for its parent to notice its end.
inline bool is_running(long process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string state;
  file >> state >> state >> state;
  return file && state != "Z" && state != "X";
}

}  // namespace tactile_net
