/// @file
/// What a skin's problem is but for its kernel. Private.
#pragma once

#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// All of `make_problem` but the kernel, its error and the constants, of any size.
/// @throw std::invalid_argument  as `make_problem`, but for the kernel's size
[[nodiscard]] LinearProblem problem_without_kernel(const SkinArray& skin, const Material& material,
                                                   const SkinProblemOptions& options);

}  // namespace tactile_net
