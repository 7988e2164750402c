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

/// [W K; sqrt(alpha) L] as products, with buffers: one thread may use it and all that shares it.
struct LargeSkinSystem;

/// Makes a system: transforms the kernels. O(cells log cells).
///
/// @throw std::invalid_argument  as `make_problem`, but for the kernel's size; offsets are unknown;
///                               the taxels do not lie on the cells' lattice
[[nodiscard]] std::shared_ptr<LargeSkinSystem> make_large_skin_system(
    const SkinArray& skin, const Material& material, const SkinProblemOptions& options);

/// The system's problem, without the kernel, which is empty.
[[nodiscard]] const LinearProblem& problem_of(const LargeSkinSystem& system) noexcept;

/// The system with these taxels dead as well.
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

/// Memory of a program that solves one frame, with bands, and writes the answer [bytes]: about, and
/// rather too much; measured (docs/internals/skin.md). Alphas below 1e-5 of the square of what
/// uniform pressure reads need larger tiles, of 0.1 GB at most.
[[nodiscard]] double large_skin_bytes(const LargeSkinSize& size) noexcept;

}  // namespace tactile_net
