/// @file
/// The face of the constraints on which a solution lies: what is still free there.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tactile_net {

/// The directions in which tractions may still change. Of friction cones none in a cell in
/// separation, two along the cone in slip (of a line one), all in stick.
struct ActiveFace {
  struct Direction {
    std::size_t cell = 0;           ///< of the grid
    std::array<double, 3> along{};  ///< direction of (p, q_y, q_z), of length 1
  };
  std::vector<Direction> free{};
};

}  // namespace tactile_net
