/// @file
/// The products of a large skin, made once and shared by all that solves with them (target
/// tactile_net::spectral).
///
///     const auto system = make_large_skin_system(skin, silicone, {});
///     const LargeSkinFamily family(system);
///     const double alpha = choose_alone(family.analyse(readings), AlphaRule::rgcv).alpha;
///     LargeSkinTikhonov solver(system, alpha);
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// [W K; sqrt(alpha) L] as products. Its buffers are one thread's, and so is all that shares it.
struct LargeSkinSystem;

/// Transforms the kernels. O(cells log cells).
///
/// @throw std::invalid_argument  as `make_problem`, but for the kernel's size; offsets are unknown;
///                               the taxels do not lie on the cells' lattice
[[nodiscard]] std::shared_ptr<LargeSkinSystem> make_large_skin_system(
    const SkinArray& skin, const Material& material, const SkinProblemOptions& options);

/// All but the kernel, which is empty.
[[nodiscard]] const SkinProblem& problem_of(const LargeSkinSystem& system) noexcept;

/// The same where these taxels are dead too.
/// @pre  they are taxels of the skin
[[nodiscard]] std::shared_ptr<LargeSkinSystem> without_taxels(
    const LargeSkinSystem& system, const std::vector<std::size_t>& taxels);

/// W K f. @pre  there is one value per traction
[[nodiscard]] std::vector<double> weighted_product(LargeSkinSystem& system,
                                                   std::span<const double> tractions);

/// What a large skin's memory depends on.
struct LargeSkinSize {
  std::size_t cells = 0;
  std::size_t components = 3;
  std::size_t channels = 3;
  std::size_t dead_taxels = 0;
  bool constrained = false;
};

/// What a program takes in memory that solves one frame of it, with bands, and writes the answer,
/// about, and rather more than less [bytes]: measured (docs/internals/skin.md). Alphas below 1e-5
/// of the square of what even pressure reads have larger tiles, of 0.1 GB at most.
[[nodiscard]] double large_skin_bytes(const LargeSkinSize& size) noexcept;

}  // namespace tactile_net
