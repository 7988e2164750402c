#include "tactile_net/scene/bounded_text.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

constexpr std::uintmax_t largest_input = std::uintmax_t{16} << 20;
constexpr const char* input_hint = "is this the right file? they have some hundred bytes";

[[noreturn]] void refuse(const std::filesystem::path& path, std::string message,
                         std::string hint = {}) {
  Diagnostic diagnostic;
  diagnostic.file = path.string();
  diagnostic.message = std::move(message);
  diagnostic.hint = std::move(hint);
  throw InputError{{std::move(diagnostic)}};
}

[[noreturn]] void refuse_size(const std::filesystem::path& path, std::uintmax_t largest,
                              const std::string& hint) {
  refuse(path, "is larger than " + std::to_string(largest >> 20U) + " MiB", hint);
}

}  // namespace

std::string bounded_text(const std::filesystem::path& path, std::uintmax_t largest,
                         const std::string& hint) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse(path, "no such file");
  if (status.type() == fs::file_type::none) refuse(path, "cannot be read: " + error.message());
  if (fs::is_directory(status)) refuse(path, "is a folder", "name the file inside it");
  if (!fs::is_regular_file(status))
    refuse(path, "is not a regular file", "save it to a file first");
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > largest) refuse_size(path, largest, hint);

  errno = 0;
  std::ifstream in{path, std::ios::binary};
  if (!in) refuse(path, std::string{"cannot be read: "} + std::strerror(errno));
  return bounded_text(in, path.string(), largest, hint);
}

std::string bounded_text(std::istream& in, const std::string& name, std::uintmax_t largest,
                         const std::string& hint) {
  std::string text;
  char block[65536];
  while (in.read(block, sizeof block) || in.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > largest) refuse_size(name, largest, hint);
  }
  if (in.bad()) refuse(name, "cannot be read to its end");
  return text;
}

std::string input_text(const std::filesystem::path& path) {
  return bounded_text(path, largest_input, input_hint);
}

std::string input_text(std::istream& in, const std::string& name) {
  return bounded_text(in, name, largest_input, input_hint);
}

}  // namespace tactile_net
