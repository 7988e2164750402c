/// @file
/// The arrays of a .npz file. Private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

/// An array in C order: numbers, or texts.
struct NpzArray {
  std::vector<std::size_t> shape{};
  std::vector<double> numbers{};
  std::vector<std::string> texts{};
};

/// A .npz file as numpy.savez writes it; what is compressed or an object is refused where it is
/// asked for.
class NpzFile {
 public:
  /// @throw std::runtime_error  it cannot be read, or is no such archive
  explicit NpzFile(std::filesystem::path path);

  [[nodiscard]] bool has(std::string_view name) const { return entries_.contains(name); }
  /// @param most  numbers or texts, at most
  /// @throw std::runtime_error  there is none, it is compressed, too large, cut off, or neither
  ///                            numbers nor text
  [[nodiscard]] NpzArray array(std::string_view name, std::size_t most) const;

 private:
  struct Entry {
    std::size_t at = 0;    ///< of its local header
    std::size_t size = 0;  ///< of its bytes
    bool stored = false;
  };

  std::filesystem::path path_;
  std::uint64_t bytes_ = 0;  ///< of the file
  std::map<std::string, Entry, std::less<>> entries_{};
};

}  // namespace tactile_net
