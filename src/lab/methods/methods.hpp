/// @file
/// The makers of the methods' solvers, a file each.
#pragma once

#include <functional>

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
                                                           double alpha);

/// What weighs one frame's functional.
using ChooseAlpha = std::function<ChosenAlpha(const SceneFrame&)>;

/// tikhonov or closed_form with an alpha for each frame, and where the scene has it estimated a
/// tangential weight: the one place where a frame is analysed, weighed and solved.
[[nodiscard]] std::unique_ptr<FrameSolver> make_solver_of_frames(const SceneProblem& problem,
                                                                 Method method, ChooseAlpha choose);

/// By the scene's rule on the tractions that the constraints leave free, which depend on alpha: the
/// two are found in turn until they agree. @pre  the scene has constraints
[[nodiscard]] ChosenAlpha alpha_on_active_set(const SceneFrame& frame);

}  // namespace tactile_net::lab
