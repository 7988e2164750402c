#include "scene/excerpt.hpp"

#include <algorithm>

namespace tactile_net {

namespace {

constexpr std::size_t widest = 120;
constexpr std::size_t around = 40;  // code points kept on either side of the column

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

std::size_t byte_of_column(std::string_view line, std::size_t column) noexcept {
  std::size_t byte = 0;
  for (std::size_t at = 1; at < column && byte < line.size(); ++at)
    byte += std::max<std::size_t>(1, code_point_size(line.substr(byte)));
  return byte;
}

std::size_t code_points(std::string_view text) noexcept {
  std::size_t points = 0;
  for (std::size_t byte = 0; byte < text.size(); ++points)
    byte += std::max<std::size_t>(1, code_point_size(text.substr(byte)));
  return points;
}

Excerpt excerpt(std::string_view line, std::size_t column) {
  const std::size_t length = code_points(line);
  if (length <= widest) return {std::string{line}, 1};

  const std::size_t centre = std::clamp<std::size_t>(column, 1, length + 1);
  const std::size_t first = centre > around + 4 ? centre - around : 1;
  const std::size_t last = std::min(length, first + 2 * around);
  const std::size_t begin = byte_of_column(line, first);
  const std::size_t end = byte_of_column(line, last + 1);
  Excerpt part{std::string{line.substr(begin, end - begin)}, first};
  if (first > 1) {
    part.text.insert(0, "...");
    part.column -= 3;
  }
  if (last < length) part.text += "...";
  return part;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t byte = 0; byte < text.size();) {
    const std::size_t size = code_point_size(text.substr(byte));
    const auto first = static_cast<unsigned char>(text[byte]);
    const bool low_control = (first < 0x20 && first != '\t') || first == 0x7F;
    const bool high_control =
        size == 2 && first == 0xC2 && static_cast<unsigned char>(text[byte + 1]) < 0xA0;
    if (size == 0 || low_control || high_control)
      result += '?';
    else
      result += text.substr(byte, size);
    byte += std::max<std::size_t>(1, size);
  }
  return result;
}

}  // namespace tactile_net
