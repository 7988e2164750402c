#include "report/json/scene_json.hpp"

#include "report/load_dimension.hpp"
#include "tactile_net/lab/answer_fields.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {
namespace {

SceneFrameTold told_with(const auto& scene) {
  SceneFrameTold told;
  told.scene = scene.file;
  for (const auto& [effect, present] : effects(scene))
    (present ? told.effects.simulated : told.effects.absent).push_back(effect);
  told.units = units_told(scene.units, load_dimension(scene));
  if (scene.time)
    told.frame.value = FrameTold{
        .index = scene.frame, .of = scene.time->frames, .t = scene.time->time(scene.frame)};
  return told;
}

}  // namespace

SceneFrameTold scene_told(const Scene& scene) { return told_with(scene); }
SceneFrameTold scene_told(const SkinScene& scene) { return told_with(scene); }
SceneFrameTold scene_told(const AnyScene& scene) {
  return std::visit([](const auto& one) { return scene_told(one); }, scene);
}

IfAny<UnitsTold> units_told(const std::optional<Units>& units, Dimension load) {
  if (!units) return {};
  return {UnitsTold{.length = si_unit(Dimension::length),
                    .stress = si_unit(Dimension::stress),
                    .force = si_unit(load),
                    .stated = {.length = units->length.name,
                               .modulus = units->modulus.name,
                               .stress = units->stress.name,
                               .force = units->force.name}}};
}

}  // namespace tactile_net::report
