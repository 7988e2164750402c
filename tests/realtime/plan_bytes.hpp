/// @file
/// A plan's checksum by another hand, to sign plans that were changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tactile_net {

/// CRC-64/XZ, bit by bit.
inline std::uint64_t crc64(std::span<const std::byte> bytes) {
  std::uint64_t sum = ~std::uint64_t{0};
  for (const std::byte byte : bytes) {
    sum ^= std::to_integer<std::uint64_t>(byte);
    for (int bit = 0; bit < 8; ++bit)
      sum = (sum & 1) != 0 ? (sum >> 1) ^ 0xC96C5795D7870F42U : sum >> 1;
  }
  return ~sum;
}

/// Writes the length and the checksum that fit; `bytes`: header, payload and room for a checksum.
inline void sign(std::span<std::byte> bytes) {
  const auto put = [&](std::size_t at, std::uint64_t value) {
    for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
  };
  put(12, bytes.size() - 28);
  put(bytes.size() - 8, crc64(bytes.first(bytes.size() - 8)));
}

}  // namespace tactile_net
