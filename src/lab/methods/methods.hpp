/// @file
/// The makers of the methods' solvers, a file each.
#pragma once

#include "tactile_net/lab/method.hpp"

namespace tactile_net::lab {

[[nodiscard]] std::unique_ptr<FrameSolver> make_dft(const SceneProblem& problem,
                                                    std::optional<double> alpha);
[[nodiscard]] std::unique_ptr<FrameSolver> make_tikhonov(const SceneProblem& problem,
                                                         std::optional<double> alpha);
[[nodiscard]] std::unique_ptr<FrameSolver> make_closed_form(const SceneProblem& problem,
                                                            std::optional<double> alpha);

/// tikhonov's minimiser by conjugate gradients: for many tractions.
[[nodiscard]] std::unique_ptr<FrameSolver> make_conjugate_gradients(const SceneProblem& problem,
                                                                    std::optional<double> alpha);
/// tikhonov under the scene's constraints. @pre  it has some
[[nodiscard]] std::unique_ptr<FrameSolver> make_active_set(const SceneProblem& problem,
                                                           std::optional<double> alpha);

}  // namespace tactile_net::lab
