/// @file
/// Runs the command: in this process, or as a user does.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/simulator/child_process.hpp"
#include "tests/catch.hpp"
#include "tests/cli/in_process.hpp"
#include "tests/replaced.hpp"

namespace tactile_net {

/// A temporary folder that is removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "tactile-net-cli-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string operator/(const std::string& name) const {
    return (path_ / name).string();
  }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return *this / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline ProcessResult run_tool(const std::vector<std::string>& arguments,
                              const std::string& input = {}) {
  return test::run_in_process(arguments, input);
}

/// The program itself, for what only a process has: pipes, signals, an environment.
inline ProcessResult program(std::vector<std::string> arguments, const std::string& input = {}) {
  arguments.insert(arguments.begin(), TOOL);
  return run_process(arguments, {.input = input});
}

inline std::string scene(const std::string& name) {
  std::string path = SCENES "/";
  return path += name;
}

/// scenes/skins/circuit.toml with 3 x 3 taxels in place of 4 x 4: its circuit takes a fifth of the
/// time.
inline std::string small_skin_circuit(const Folder& folder) {
  std::string text = read_text(scene("skins/circuit.toml"));
  text = replaced(text, "\"A skin of 4 x 4", "\"A skin of 3 x 3");
  text = replaced(replaced(text, "rows = 4", "rows = 3"), "columns = 4", "columns = 3");
  return folder.write("circuit.toml", text);
}

inline const std::string small_scene =
    "[sensor]\ncount = 3\npitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n"
    "[reconstruct]\nalpha = 1e-3\nsurface = \"taxels\"\n";

inline const std::string cylinder_load =
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n";

}  // namespace tactile_net
