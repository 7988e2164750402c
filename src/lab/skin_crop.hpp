/// @file
/// The part of a large skin where a frame is strongest, small enough for dense matrices. Private.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::lab {

struct SkinCrop {
  SkinScene scene{};  ///< of those taxels, without contacts
  std::vector<double> readings{};
};

/// Taxels about the one whose weighted readings are largest, as many along each side as the depth
/// and its cells allow.
///
/// @pre  the skin is even and has its readings
[[nodiscard]] SkinCrop strongest_part(const SkinSceneProblem& problem,
                                      std::span<const double> readings);

}  // namespace tactile_net::lab
