/// @file
/// The tables of a scene, one function each: from checked values to plain data.
#pragma once

#include <vector>

#include "scene/table.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net {

/// Fills the scene from the whole file; what is wrong goes to the problems that `root` was made
/// with, and then the scene is not complete.
void read_sections(Table& root, Scene& scene);

/// The contacts; `array` has count 0 or pitch 0 where that was wrong, and is then not compared
/// with.
[[nodiscard]] std::vector<Contact> read_contacts(std::vector<Table> tables,
                                                 const SensorArray& array);

}  // namespace tactile_net
