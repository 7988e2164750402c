#include "report/json/scene_json.hpp"

#include "tactile_net/lab/answer_fields.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {
namespace {

SceneFrameTold told_with(const auto& scene, Dimension force) {
  SceneFrameTold told;
  told.scene = scene.file;
  for (const auto& [effect, present] : effects(scene))
    (present ? told.effects.simulated : told.effects.absent).push_back(effect);
  if (scene.units) told.units.value = units_told(*scene.units, force);
  if (scene.time)
    told.frame.value = FrameTold{
        .index = scene.frame, .of = scene.time->frames, .t = scene.time->time(scene.frame)};
  return told;
}

Json scene_document(const DocumentKind& kind, const SceneFrameTold& told) {
  Json json = document(kind);
  add_fields(json, told);
  return json;
}

}  // namespace

SceneFrameTold scene_told(const Scene& scene) { return told_with(scene, Dimension::force); }
SceneFrameTold scene_told(const SkinScene& scene) {
  return told_with(scene, Dimension::point_force);
}
SceneFrameTold scene_told(const AnyScene& scene) {
  return std::visit([](const auto& one) { return scene_told(one); }, scene);
}

Json scene_json(const DocumentKind& kind, const Scene& scene) {
  return scene_document(kind, scene_told(scene));
}
Json scene_json(const DocumentKind& kind, const SkinScene& scene) {
  return scene_document(kind, scene_told(scene));
}

UnitsTold units_told(const Units& units, Dimension force) {
  return {.length = si_unit(Dimension::length),
          .stress = si_unit(Dimension::stress),
          .force = si_unit(force),
          .stated = {.length = units.length.name,
                     .modulus = units.modulus.name,
                     .stress = units.stress.name,
                     .force = units.force.name}};
}

}  // namespace tactile_net::report
