/// @file
/// The closed form of thesis chapter 4 (4.14-4.15) with its errata corrected. One of the thesis'
/// own methods, kept to be compared with: `tikhonov` (inverse/reconstruction.hpp) has the same
/// answer in less time.
#pragma once

#include <optional>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {

/// f = G h + c with h = f' between neighbours, G the cumulative sum times D, c the constant that
/// the thesis misprints. Eliminating h by a QR of [W K G; sqrt(alpha) G; sqrt(alpha) l I] leaves c
/// as the ratio c = r_v'r_u / r_v'r_v of two residuals: the corrected form of 4.15 with nothing
/// squared. The minimiser is the same as `tikhonov`'s: the two agree to rounding, by different
/// ways.
///
/// @param stacked_condition  the condition of `tikhonov` for the same problem and alpha where it is
///                           known: saves its decomposition, a third of the work
/// @throw as `tikhonov`
[[nodiscard]] Reconstruction closed_form(const LinearProblem& problem, double alpha,
                                         std::optional<double> stacked_condition = {});

}  // namespace tactile_net
