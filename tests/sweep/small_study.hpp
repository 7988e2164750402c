/// @file
/// A folder with a scene and studies of it, removed at the end.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "tactile_net/sweep/study.hpp"

namespace tactile_net::test {

inline const std::string pad =
    "[sensor]\ncount = 9\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
    "[noise]\nrms = 0.01\nseed = 7\n"
    "[reconstruct]\nmethods = [\"tikhonov\", \"dft\"]\nalpha = 1e-3\n";

/// 3 x 2 x 4 points.
inline const std::string grid_study =
    "scene = \"pad.toml\"\nseed = 3\nrepeats = 4\n"
    "[[axis]]\nkey = \"sensor.depth\"\nvalues = [1.0, 1.5, 2]\n"
    "[[axis]]\nkey = \"contact.0.half_width\"\nvalues = [0.5, 1.0]\n";

class StudyFolder {
 public:
  StudyFolder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "tactile-net-sweep-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
    write("pad.toml", pad);
  }
  ~StudyFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] sweep::Study study(const std::string& text) const {
    return sweep::Study(read_study(write("study.toml", text)));
  }

 private:
  std::filesystem::path path_;
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace tactile_net::test
