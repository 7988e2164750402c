// Sensors by name: what is known of them without a recording, in one place for the command and for
// Python.
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <map>

#include "rooms.hpp"
#include "tactile_net/scene/known_sensor.hpp"

namespace tactile_net::python {

namespace nb = nanobind;

void bind_sensors(nb::module_& module) {
  module.def(
      "sensor_refusal", [](const std::string& sensor) { return known_sensor(sensor).refusal; },
      nb::arg("sensor"));
  module.def(
      "sensor_lattice", [](const std::string& sensor) { return known_sensor(sensor).lattice; },
      nb::arg("sensor"));
  module.def(
      "sensor_models", [](const std::string& sensor) { return known_sensor(sensor).models; },
      nb::arg("sensor"));
  module.attr("modulus_not_needed") = modulus_not_needed;
}

}  // namespace tactile_net::python
