#include "simulator/program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace tactile_net {
namespace {

namespace fs = std::filesystem;

bool runs(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

std::string program_file(const std::string& name) {
  std::error_code ignored;
  if (name.find('/') != std::string::npos) return fs::absolute(name, ignored).string();
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable == nullptr ? "/bin:/usr/bin" : variable;
  for (bool more = true; more;) {
    const std::size_t colon = folders.find(':');
    more = colon != std::string_view::npos;
    const fs::path file = fs::absolute(fs::path(folders.substr(0, colon)) / name, ignored);
    if (runs(file)) return file.string();
    folders.remove_prefix(more ? colon + 1 : folders.size());
  }
  return name;
}

bool is_script(const std::string& file) {
  char begin[2] = {};
  std::ifstream(file, std::ios::binary).read(begin, sizeof begin);
  return begin[0] == '#' && begin[1] == '!';
}

}  // namespace tactile_net
