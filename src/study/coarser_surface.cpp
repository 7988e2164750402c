#include <span>
#include <vector>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/sensing/resampled.hpp"

namespace tactile_net::study {
namespace {

/// Scenes on ever coarser grids, the steps doubled as long as that makes one.
std::vector<Scene> coarser_scenes(const Scene& scene) {
  std::vector<Scene> scenes;
  Surface last = surface(scene);
  if (last.basis != SurfaceBasis::hats) return scenes;
  constexpr std::size_t fewest = 5;  // values
  for (;;) {
    Scene next = scene;
    next.reconstruct.surface.spacing = 2.0 * last.spacing * (1.0 + 1e-9);
    const Surface coarse = surface(next);
    if (coarse.count >= last.count || coarse.count < fewest) return scenes;
    last = coarse;
    scenes.push_back(std::move(next));
  }
}

}  // namespace

bool has_coarser_surface(const Scene& scene) { return !coarser_scenes(scene).empty(); }

StudySection coarser_surface(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::coarser_surface};
  const Surface own = surface(input.line().scene());
  for (const Scene& scene : coarser_scenes(input.line().scene())) {
    const lab::SceneProblem coarse(scene);
    const Knob knob{.kind = Knob::Kind::surface_values, .count = coarse.surface().count};
    attempt(section, curve, knob, [&] {
      // Alpha does not follow the spacing.
      const PlannedFrame frame =
          planned_frame(coarse.problem(), input.alpha, input.readings, clock);
      WorkPoint result = point(input, curve, knob,
                               resampled(frame.tractions, coarse.surface(), own), frame.seconds);
      result.error_to_solution.reset();  // fewer unknowns, another problem
      return result;
    });
  }
  return section;
}

}  // namespace tactile_net::study
