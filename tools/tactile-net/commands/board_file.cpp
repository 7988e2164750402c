#include "commands/board_file.hpp"

#include <cstdint>

#include "tactile_net/scene/bounded_text.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::uintmax_t largest_board = std::uintmax_t{256} << 20U;

}  // namespace

std::optional<LaidBoard> board_if(const std::string& path) {
  if (path.empty()) return std::nullopt;
  return read_kicad_board(
      bounded_text(path, largest_board, "is this the right file? boards have some MiB"), path);
}

}  // namespace tactile_net::tool
