/// @file
/// Where axes that are drawn take their values. Private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tactile_net/scene/study_file.hpp"

namespace tactile_net::sweep {

/// Numbers in [0, 1): a column for each key. More draws begin with the same ones.
///
/// random: each depends on seed, key and place alone. sobol: the points of Sobol's sequence with
/// Joe and Kuo's direction numbers, without its first, 0; the seed has no part in it.
[[nodiscard]] std::vector<std::vector<double>> draws(DrawKind kind, std::uint64_t seed,
                                                     const std::vector<std::string>& keys,
                                                     std::size_t count);

/// 53 bits that follow from a text.
[[nodiscard]] std::uint64_t number_of(const std::string& text);

}  // namespace tactile_net::sweep
