/// @file
/// How the programs that write docs do it.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace tactile_net::tool {

/// To a temporary name, then renamed. @throw std::runtime_error  it cannot be written
inline void write_file(const std::filesystem::path& target, const std::string& text) {
  std::filesystem::path partial = target;
  partial += ".partial";
  std::ofstream file(partial, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(partial.string() + " could not be written");
  std::filesystem::rename(partial, target);
}

}  // namespace tactile_net::tool
