// An alpha that neighbouring frames of a recording share.
#include <memory>
#include <stdexcept>

#include "lab/frame_sharing.hpp"
#include "lab/methods/methods.hpp"

namespace tactile_net::lab {

std::unique_ptr<FrameSolver> make_sharing_solver(const SceneProblem& problem, Method method,
                                                 std::size_t frames) {
  if (!traits(method).has_bands)
    throw std::invalid_argument(
        "frames share an alpha that a rule chooses for tikhonov or closed_form: choose one of "
        "them");
  const auto sharing = std::make_shared<FrameSharing>(problem, frames);
  if (problem.chooses_on_active_set())
    throw std::invalid_argument(
        "frames share an alpha that is chosen as without constraints: leave out "
        "alpha_on_active_set");
  return make_solver_of_frames(problem, method, [=](const SceneFrame& frame) {
    const AlphaChoice choice = sharing->push(frame.problem(), frame.analysed());
    return ChosenAlpha{.value = choice.alpha, .rule = choice.rule, .verdict = choice.verdict};
  });
}

}  // namespace tactile_net::lab
