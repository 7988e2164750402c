/// @file
/// SHA-256 (FIPS 180-4): one name for equal bytes, as `sha256sum` prints it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace tactile_net {

/// SHA-256 of the bytes.
[[nodiscard]] std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// SHA-256 of the bytes, as 64 hexadecimal digits.
[[nodiscard]] std::string sha256_text(std::string_view bytes);

}  // namespace tactile_net
