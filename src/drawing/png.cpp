#include "tactile_net/drawing/png.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tactile_net::drawing {
namespace {

/// Most significant byte first.
void append_big_endian(std::string& out, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>((value >> shift) & 0xffU);
}

constexpr std::array<std::uint32_t, 256> crc_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}();

std::uint32_t crc(std::string_view bytes) noexcept {
  std::uint32_t c = 0xffffffffU;
  for (const char byte : bytes)
    c = crc_table[(c ^ static_cast<std::uint8_t>(byte)) & 0xffU] ^ (c >> 8);
  return ~c;
}

std::uint32_t adler32(std::string_view bytes) noexcept {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<std::uint8_t>(byte)) % 65521U;
    b = (b + a) % 65521U;
  }
  return (b << 16) | a;
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_big_endian(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out += type;
  out += data;
  append_big_endian(out, crc(std::string_view(out).substr(start)));
}

/// As zlib would write it at level 0 (RFC 1950, 1951): blocks that are stored.
std::string stored(std::string_view bytes) {
  constexpr std::size_t most = 65535;
  std::string out = {'\x78', '\x01'};
  for (std::size_t at = 0; at < bytes.size(); at += most) {
    const std::string_view block = bytes.substr(at, most);
    const auto size = static_cast<unsigned>(block.size());
    out += at + block.size() == bytes.size() ? '\x01' : '\x00';
    for (const unsigned value : {size, ~size}) {
      out += static_cast<char>(value & 0xffU);
      out += static_cast<char>((value >> 8) & 0xffU);
    }
    out += block;
  }
  append_big_endian(out, adler32(bytes));
  return out;
}

}  // namespace

Palette diverging(Colour negative, Colour positive) noexcept {
  Palette palette{};
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const double value = (static_cast<double>(i) - 128.0) / 127.0;
    palette[i] = value < 0.0 ? negative : positive;
    // The eye resolves faint colours better than full ones.
    palette[i].opacity = static_cast<std::uint8_t>(
        std::lround(255.0 * std::pow(std::min(std::abs(value), 1.0), 0.8)));
  }
  return palette;
}

Palette ramp(std::span<const Colour> stops) noexcept {
  Palette palette{};
  for (std::size_t i = 0; i < palette.size(); ++i) {
    // Index 1 is the first stop and 255 the last, so that 128 is the middle.
    const double at =
        std::max(static_cast<double>(i) - 1.0, 0.0) / 254.0 * static_cast<double>(stops.size() - 1);
    const std::size_t stop = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const double share = at - static_cast<double>(stop);
    const auto between = [&](std::uint8_t Colour::*part) {
      return static_cast<std::uint8_t>(
          std::lround((1.0 - share) * (stops[stop].*part) + share * (stops[stop + 1].*part)));
    };
    palette[i] = {between(&Colour::red), between(&Colour::green), between(&Colour::blue)};
  }
  return palette;
}

std::uint8_t ramp_index(double value) noexcept {
  if (std::isnan(value)) return 1;
  return static_cast<std::uint8_t>(std::lround(1.0 + 254.0 * std::clamp(value, 0.0, 1.0)));
}

std::uint8_t diverging_index(double value) noexcept {
  if (std::isnan(value)) return 128;
  return static_cast<std::uint8_t>(std::lround(128.0 + 127.0 * std::clamp(value, -1.0, 1.0)));
}

std::string png(std::size_t width, std::size_t height, std::span<const std::uint8_t> pixels,
                const Palette& palette) {
  constexpr std::size_t longest = std::numeric_limits<std::int32_t>::max();
  if (width == 0 || height == 0 || width > longest || height > longest)
    throw std::invalid_argument("a picture's sides must be 1 to 2^31 - 1 pixels");
  if (pixels.size() != width * height)
    throw std::invalid_argument("a picture needs one byte per pixel");

  std::string header;
  append_big_endian(header, static_cast<std::uint32_t>(width));
  append_big_endian(header, static_cast<std::uint32_t>(height));
  header += {'\x08', '\x03', '\x00', '\x00', '\x00'};  // 8 bits, by palette
  std::string colours;
  std::string opacities;
  for (const Colour& colour : palette) {
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue})
      colours += static_cast<char>(part);
    opacities += static_cast<char>(colour.opacity);
  }
  std::string rows;
  rows.reserve(height * (width + 1));
  for (std::size_t row = 0; row < height; ++row) {
    rows += '\0';  // no filter
    for (const std::uint8_t pixel : pixels.subspan(row * width, width))
      rows += static_cast<char>(pixel);
  }

  std::string file = "\x89PNG\r\n\x1a\n";
  append_chunk(file, "IHDR", header);
  append_chunk(file, "PLTE", colours);
  append_chunk(file, "tRNS", opacities);
  append_chunk(file, "IDAT", stored(rows));
  append_chunk(file, "IEND", "");
  return file;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::string_view three = bytes.substr(at, 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (i < three.size() ? static_cast<std::uint8_t>(three[i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= three.size() ? digits[(bits >> (18 - 6 * i)) & 63U] : '=';
  }
  return text;
}

}  // namespace tactile_net::drawing
