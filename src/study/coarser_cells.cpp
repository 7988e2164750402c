#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"

namespace tactile_net::study {
namespace {

/// Between which two of `count` values a place lies, in their spacings from the first, and how far
/// from the one to the other. Beyond the ends the last one holds.
struct Between {
  std::size_t first = 0;
  std::size_t second = 0;
  double share = 0.0;
};
Between between(double place, std::size_t count) {
  const double within = std::clamp(place, 0.0, static_cast<double>(count - 1));
  const auto first = static_cast<std::size_t>(within);
  return {first, std::min(first + 1, count - 1), within - static_cast<double>(first)};
}

/// Linear between the middles of cells, along y and z.
std::vector<double> on_grid(std::span<const double> f, std::size_t components,
                            const SurfaceGrid& from, const SurfaceGrid& to) {
  std::vector<double> result;
  for (std::size_t u = 0; u < components; ++u) {
    const auto values = f.subspan(u * from.count(), from.count());
    for (std::size_t row = 0; row < to.rows; ++row)
      for (std::size_t column = 0; column < to.columns; ++column) {
        const Between y = between((to.y(row) - from.y(0)) / from.spacing_y, from.rows);
        const Between z = between((to.z(column) - from.z(0)) / from.spacing_z, from.columns);
        const auto along_z = [&](std::size_t at) {
          return std::lerp(values[at * from.columns + z.first],
                           values[at * from.columns + z.second], z.share);
        };
        result.push_back(std::lerp(along_z(y.first), along_z(y.second), y.share));
      }
  }
  return result;
}

/// Scenes on ever wider cells, down to one a taxel; of uneven taxels twice and four times as wide.
std::vector<SkinScene> coarser_scenes(const lab::SkinSceneProblem& skin) {
  const SurfaceGrid& own = skin.grid();
  const double spacing = std::max(own.spacing_y, own.spacing_z);
  std::vector<SkinScene> scenes;
  std::size_t before = own.count();
  const auto add = [&](double wider) {
    SkinScene scene = skin.scene();
    scene.reconstruct.grid.spacing = spacing * wider * (1.0 + 1e-9);
    const std::size_t count = grid(scene).count();
    if (count >= before) return;
    before = count;
    scenes.push_back(std::move(scene));
  };
  const std::size_t stride = std::max(own.stride_rows, own.stride_columns);
  if (stride == 0)
    for (const double wider : {2.0, 4.0}) add(wider);
  for (std::size_t cells = stride; cells-- > 1;)
    add(static_cast<double>(stride) / static_cast<double>(cells));
  return scenes;
}

}  // namespace

bool has_coarser_cells(const lab::SkinSceneProblem& skin) { return !coarser_scenes(skin).empty(); }

StudySection coarser_cells(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::coarser_surface};
  const SurfaceGrid& own = input.skin().grid();
  for (const SkinScene& scene : coarser_scenes(input.skin())) {
    StudyInput coarse{.problem = lab::SkinSceneProblem(scene), .alpha = input.alpha};
    const LinearProblem& problem = coarse.skin().problem();
    const Knob knob{.kind = Knob::Kind::surface_values, .count = problem.grid.count()};
    attempt(section, curve, knob, [&] {
      // Alpha does not follow the spacing.
      const PlannedFrame frame = timed_frame(plan_of(coarse, {}).plan, input.readings, clock);
      WorkPoint result =
          point(input, curve, knob, on_grid(frame.tractions, problem.components, problem.grid, own),
                frame.seconds);
      result.error_to_solution.reset();  // fewer unknowns, another problem
      return result;
    });
  }
  return section;
}

}  // namespace tactile_net::study
