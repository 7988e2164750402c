/// @file
/// Private. How what is said of a scene begins, of a line or a skin.
#pragma once

#include <ostream>

#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::report {

/// The file, its title, the sensor and the material.
void print_head(std::ostream& out, const auto& scene) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << '\n';
}

}  // namespace tactile_net::report
