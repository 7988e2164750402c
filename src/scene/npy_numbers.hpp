/// @file
/// Numbers of a .npy file, of whatever type, as doubles. Private.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace tactile_net {

/// How one type of numbers is read.
struct NpyNumbers {
  std::size_t width = 0;  ///< bytes of a number; 0: the type is not read
  /// values[k] = the number at bytes + at[k], for every k.
  void (*read)(const unsigned char* bytes, std::span<const std::size_t> at,
               double* values) = nullptr;
  /// The number at `bytes`, exactly: whole numbers of 8 bytes are more than a double holds.
  std::string (*text)(const unsigned char* bytes) = nullptr;
};

/// Whole numbers of 1, 2, 4 and 8 bytes with and without a sign, floating-point ones of 2, 4 and 8,
/// of either byte order.
///
/// @param type  "<f8", ">i2", "|u1"
[[nodiscard]] NpyNumbers npy_numbers(std::string_view type);

/// What a type that is not read holds: "truth values".
[[nodiscard]] std::string_view kind_of_type(std::string_view type);

}  // namespace tactile_net
