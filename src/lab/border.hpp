/// @file
/// Whether a contact reaches beyond what taxels see: of lines and of skins. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::lab {

/// The tractions above the outermost live taxels of a line, at both of its ends, and those between
/// live taxels with several dead ones between them, more than a depth apart: rising.
[[nodiscard]] std::vector<std::size_t> border_values(const SceneProblem& problem);
/// The cells above those live taxels of a skin beside which lies a cell that no taxel sees: at the
/// skin's edges, and around dead taxels. Of a single row or column of taxels its two ends count.
/// And the cells above dead taxels that no live one sees, with those that touch them: what is
/// pressed hardest there has its peak where no taxel tells how high it is.
///
/// @param unseen  of the problem
[[nodiscard]] std::vector<std::size_t> border_cells(const SkinSceneProblem& problem,
                                                    const std::vector<bool>& unseen);

/// Whether the border is pressed nearly as hard as any place. What presses beside it is then not
/// known, and the force that is found is a lower bound: under contacts that end at the outermost
/// taxels the border has at most half of the highest pressure, under those whose middle lies there
/// nine tenths.
///
/// @param pressure  of every place
[[nodiscard]] bool presses_at_border(std::span<const double> pressure,
                                     std::span<const std::size_t> border);

}  // namespace tactile_net::lab
