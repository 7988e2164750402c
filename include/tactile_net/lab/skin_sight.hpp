/// @file
/// Where a skin's taxels see a contact, and how far one is known where they do not.
///
/// A band's prior has one size for the whole skin, and most of a skin is empty: under the taxels
/// that matters little, for the readings decide; beyond the outermost and under dead ones the prior
/// decides, and a contact is larger than the mean of the skin. There it takes the size that a prior
/// has whose energy lies in the contact alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::lab {

/// How far from its place a taxel sees what presses [m]: three quarters of the pitch, or half the
/// least depth where that is more.
[[nodiscard]] double sight_of(const SkinArray& skin);

/// Cells that lie farther than that from every live taxel: no cell between four taxels does.
[[nodiscard]] std::vector<bool> unseen_cells(const SkinSceneProblem& problem);

/// Of what presses in some cells the share in those that are not seen; 0 where nothing presses.
[[nodiscard]] double unseen_share(std::span<const double> tractions,
                                  std::span<const std::size_t> cells,
                                  const std::vector<bool>& unseen);

/// From this share on a contact counts as one that reaches where no taxel sees.
inline constexpr double most_unseen = 0.05;
/// From this share on what is found is a guess, and its verdict `cut_off`.
inline constexpr double most_guessed = 0.5;

/// The prior's alpha for what a contact's cells amount to: of `prior_alpha`, which is the whole
/// skin's. A contact that is seen takes the mean, by its logarithm, of the two sizes.
[[nodiscard]] double contact_prior(double prior_alpha, std::size_t cells, std::size_t all,
                                   bool seen) noexcept;

}  // namespace tactile_net::lab
