// In place of src/scene/scene_effects.cpp: friction and layer, which act before the readings,
// alone.
#include "tactile_net/scene/scene_effects.hpp"

#include <array>

namespace tactile_net {
namespace {

std::string no_words(const SensedScene&) { return {}; }
double no_operations(const SensedScene&) { return 0.0; }

const std::array table = {
    SceneEffect{"friction", [](const SensedScene& scene) { return scene.drags; }, nullptr, no_words,
                no_operations},
    SceneEffect{"layer", [](const SensedScene& scene) { return scene.material->layer.has_value(); },
                nullptr, no_words, no_operations}};

}  // namespace

std::span<const SceneEffect> scene_effects() { return table; }

}  // namespace tactile_net
