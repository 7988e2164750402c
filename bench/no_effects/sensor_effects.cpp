// In place of src/scene/sensor_effects.cpp: no table of an effect is known.
#include "scene/sections.hpp"

namespace tactile_net {

void read_sensor_effects(Table&, const SensorOfEffects&, const std::optional<Timing>&,
                         SensorEffects&) {}

}  // namespace tactile_net
