/// @file
/// Which methods have found the same: what a picture draws once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/lab/run.hpp"

namespace tactile_net::lab {

/// Answers that a picture cannot tell apart.
struct Agreement {
  std::vector<std::size_t> results{};  ///< indices, rising
  double difference = 0.0;  ///< largest of |f - f of the first|, over the largest |f| of the first
};

/// Every result with an answer, in groups: each joins the first whose answer has the same
/// components and differs by at most `within` of its largest traction.
[[nodiscard]] std::vector<Agreement> agreements(std::span<const MethodResult> results,
                                                double within = 2e-3);

/// How far the second answer is from the first, as `Agreement::difference`; infinite where only one
/// has a tangential traction.
[[nodiscard]] double difference(const MethodResult& first, const MethodResult& second);

}  // namespace tactile_net::lab
