#include "scene/excerpt.hpp"

#include <algorithm>

namespace tactile_net {

namespace {

constexpr std::size_t widest = 120;
constexpr std::size_t around = 40;  // code points kept on either side of the column

}  // namespace

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

}  // namespace tactile_net
