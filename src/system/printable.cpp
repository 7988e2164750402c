#include "tactile_net/system/printable.hpp"

#include <algorithm>
#include <cstdint>

namespace tactile_net {
namespace {

std::uint32_t code_point(std::string_view bytes) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() == 1) return byte(0);
  std::uint32_t value = byte(0) & (0xFFU >> (bytes.size() + 1));
  for (std::size_t i = 1; i < bytes.size(); ++i) value = value << 6U | (byte(i) & 0x3FU);
  return value;
}

bool is_control(std::uint32_t point) noexcept {
  return point < 0x20 || (point >= 0x7F && point < 0xA0);
}

/// Marks that turn the direction of writing, and the two line ends beside LF and CR.
bool misleads(std::uint32_t point) noexcept {
  return point == 0x061C || point == 0x200E || point == 0x200F ||
         (point >= 0x2028 && point <= 0x202E) || (point >= 0x2066 && point <= 0x2069);
}

void append_hex(std::string& out, std::uint32_t value, int digits) {
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4)
    out += "0123456789abcdef"[value >> static_cast<unsigned>(shift) & 0xFU];
}

enum class As { line, lines, json };

std::string made_printable(std::string_view text, As as) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t size = code_point_size(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(1, size));
    text.remove_prefix(bytes.size());
    const std::uint32_t point = code_point(bytes);
    const bool stays = bytes == "\t" || (as != As::line && bytes == "\n");
    if (as == As::json && !stays && (is_control(point) || misleads(point))) {
      result += "\\u";
      append_hex(result, point, 4);
    } else if (size == 0 || (is_control(point) && !stays)) {
      result += "\\x";
      append_hex(result, point, 2);
    } else if (misleads(point)) {
      result += "\\u";
      append_hex(result, point, 4);
    } else {
      result += bytes;
    }
  }
  return result;
}

}  // namespace

std::size_t code_point_size(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
  const bool surrogate = lead == 0xED && byte(1) >= 0xA0;
  const bool beyond = lead == 0xF4 && byte(1) >= 0x90;
  return overlong || surrogate || beyond ? 0 : size;
}

std::string printable(std::string_view text) { return made_printable(text, As::line); }

std::string printable_lines(std::string_view text) { return made_printable(text, As::lines); }

std::string printable_json(std::string_view text) { return made_printable(text, As::json); }

}  // namespace tactile_net
