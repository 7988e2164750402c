/// @file
/// A count with its noun: "1 frame", "5 frames".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tactile_net {

/// @param thing  in the singular; its plural ends in s
[[nodiscard]] inline std::string counted(std::size_t count, std::string_view thing) {
  std::string text = std::to_string(count) + ' ';
  text += thing;
  return count == 1 ? text : text + 's';
}

}  // namespace tactile_net
