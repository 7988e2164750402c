// An alpha that neighbouring frames of a recording share.
#include <memory>
#include <stdexcept>

#include "lab/methods/methods.hpp"
#include "tactile_net/inverse/shared_alpha.hpp"

namespace tactile_net::lab {

std::unique_ptr<FrameSolver> make_sharing_solver(const SceneProblem& problem, Method method,
                                                 std::size_t frames) {
  if (!traits(method).has_bands || problem.scene().reconstruct.alpha)
    throw std::invalid_argument(
        "frames share an alpha that a rule chooses for tikhonov or closed_form: this scene gives "
        "one, or the method is another");
  if (problem.estimates_weight())
    throw std::invalid_argument(
        "frames share an alpha of one functional, and here each has a tangential_weight of its "
        "own: state it");
  if (problem.chooses_on_active_set())
    throw std::invalid_argument(
        "frames share an alpha that is chosen as without constraints: leave out "
        "alpha_on_active_set");
  const auto shared = std::make_shared<std::optional<SharedAlpha>>();  // made of the first frame
  return make_solver_of_frames(problem, method, [=](const SceneFrame& frame) {
    const FilterFrame& analysed = frame.analysed();
    const SceneProblem& of = frame.problem();
    if (!*shared)
      shared->emplace(AlphaTables(analysed.gamma, analysed.rows, analysed.shares),
                      of.alpha_rule(analysed), frames, of.stated_noise());
    const AlphaChoice choice = (*shared)->push(analysed);
    return ChosenAlpha{.value = choice.alpha, .rule = choice.rule, .verdict = choice.verdict};
  });
}

}  // namespace tactile_net::lab
