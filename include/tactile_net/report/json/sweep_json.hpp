/// @file
/// A sweep as JSON: what was asked, how it went, and its rows taken together.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tactile_net/sweep/merge.hpp"

namespace tactile_net::report {

/// The document kind `sweep`. The rows themselves stand in results.csv.
///
/// @param resumed  points that an earlier call had done; absent: not known, as of a merge
[[nodiscard]] std::string sweep_json(const sweep::Table& table,
                                     std::optional<std::size_t> resumed = {});

}  // namespace tactile_net::report
