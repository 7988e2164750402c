/// @file
/// The header of a .npy file. Private.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

inline constexpr std::string_view npy_magic = "\x93NUMPY";

struct NpyHeader {
  std::string type{};          ///< "<f8", without quotes; as written where it is no string
  bool fortran_order = false;  ///< the first index runs fastest
  std::vector<std::size_t> shape{};
  std::string shape_text{};  ///< "(3, 41)"
  std::size_t size = 0;      ///< bytes before the numbers
};

/// Reads versions 1 to 3.
///
/// @param file  name for messages
/// @throw InputError  it is none, or cut off
[[nodiscard]] NpyHeader read_npy_header(std::istream& in, const std::string& file);

/// A header of 128 bytes for doubles in C order.
[[nodiscard]] std::string npy_header(std::size_t frames, std::size_t columns);

}  // namespace tactile_net
