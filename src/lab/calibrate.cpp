#include "tactile_net/lab/calibrate.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

namespace tactile_net::lab {

namespace {

PressModel model_of(const Scene& scene) {
  return {scene.sensor, scene.material, scene.crosstalk ? scene.crosstalk->fraction : 0.0};
}

}  // namespace

SceneCalibration calibrate(const Scene& scene, PressLog log, const CalibrationOptions& options,
                           const std::function<void(std::size_t)>& watch) {
  const PressModel model = model_of(scene);
  const std::vector<Site>& sites = model.sites();
  const auto unread = std::make_unique<bool[]>(sites.size());
  for (std::size_t j = 0; j < sites.size(); ++j)
    unread[j] = std::count(scene.dead_taxels.begin(), scene.dead_taxels.end(), sites[j].taxel) > 0;
  SceneCalibration result{.scene = scene, .options = options, .log = std::move(log)};
  result.fit =
      fit_presses(model, result.log, options, std::span(unread.get(), sites.size()), watch);
  const auto [first, last] = std::minmax_element(
      result.fit.presses.begin(), result.fit.presses.end(),
      [](const FittedPress& a, const FittedPress& b) { return a.center.value < b.center.value; });
  result.spread = last->center.value - first->center.value;
  return result;
}

void plan_presses(SceneCalibration& found, std::size_t count, std::optional<PadParameter> target) {
  found.target = target;
  found.next =
      next_presses(model_of(found.scene), found.log, found.options, found.fit, count, target);
}

}  // namespace tactile_net::lab
