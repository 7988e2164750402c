/// @file
/// The alpha that a pad's tractions are reconstructed with.
#pragma once

#include "tests/inverse/pads.hpp"

namespace tactile_net {

inline constexpr double pad_alpha = 1e-4;

}  // namespace tactile_net
