#include <cstddef>
#include <vector>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/sensing/resampled.hpp"

namespace tactile_net::study {
namespace {

/// Every `stride`-th taxel of the scene. Alpha keeps its meaning: all sums of the functional have
/// as many terms fewer.
WorkPoint coarser(const StudyInput& input, std::size_t stride, const WorkCurve& curve,
                  const Knob& knob, const lab::Clock& clock) {
  Scene scene = input.line().scene();
  scene.sensor = every(input.line().scene().sensor, stride);
  const Surface places = surface(input.line().scene());
  const bool on_grid = places.basis == SurfaceBasis::hats;  // which stays as it is
  if (on_grid) scene.reconstruct.surface.spacing = places.spacing;
  std::vector<double> g;
  for (std::size_t i = 0; const Site& site : sites(input.line().scene().sensor)) {
    if (site.taxel % stride == 0) g.push_back(input.readings[i]);
    ++i;
  }
  auto [f, seconds] = planned_frame(lab::SceneProblem(scene).problem(), input.alpha, g, clock);
  if (!on_grid) f = resampled(f, surface(scene), places);
  WorkPoint result = point(input, curve, knob, f, seconds);
  result.error_to_solution.reset();  // fewer readings, another problem
  return result;
}

}  // namespace

StudySection fewer_taxels(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::fewer_taxels};
  const std::size_t n = input.line().scene().sensor.count;
  for (std::size_t stride = 2; stride <= (n - 1) / 4; ++stride) {
    if ((n - 1) % stride != 0) continue;
    if (!input.line().scene().dead_taxels.empty()) {
      section.points.push_back(
          failed(curve, {}, TimeOf::frame, {.kind = Failure::Kind::dead_taxels}));
      break;
    }
    const Knob knob{.kind = Knob::Kind::taxels, .count = (n - 1) / stride + 1};
    attempt(section, curve, knob, [&] { return coarser(input, stride, curve, knob, clock); });
  }
  if (section.points.empty())
    section.points.push_back(
        failed(curve, {}, TimeOf::frame, {.kind = Failure::Kind::no_stride, .count = n}));
  return section;
}

}  // namespace tactile_net::study
