/// @file
/// The tables of a scene, one function each: from checked values to plain data.
#pragma once

#include <optional>
#include <vector>

#include "scene/table.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net {

/// Fills the scene from the whole file; what is wrong goes to the problems that `root` was made
/// with, and then the scene is not complete.
void read_sections(Table& root, Scene& scene);

/// The contacts; the sensor has count 0 or pitch 0 where that was wrong, and is then not compared
/// with.
///
/// @param timed  the scene has a table [time]
void read_contacts(std::vector<Table> tables, bool timed, Scene& scene);

/// What later sections need to know of earlier ones beyond the scene itself.
struct Read {
  std::optional<Value> reads{};
  bool reads_complete = false;  ///< `sensor.reads` was understood as a whole
  bool depths_complete = false;
  bool timed = false;  ///< there is a table [time]
};

/// The tables of what lies between the pad and the file: [noise], [quantization] and their like.
void read_sensor_effects(Table& root, const Read& read, Scene& scene);

[[nodiscard]] inline std::optional<Table> table_of(const std::optional<Value>& value) {
  return value ? value->table() : std::nullopt;
}

}  // namespace tactile_net
