// What Python calls: types and errors as the library has them, arrays, no rule of its own.
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include "rooms.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/json/schema.hpp"

NB_MODULE(_core, module) {
  using namespace tactile_net::python;
  module.doc() = "The library behind tactile_net. Private: its names may change.";
  module.attr("version") = tactile_net::version();
  module.def("schema", &tactile_net::report::schema, nanobind::arg("kind"));
  bind_errors();
  bind_option_words();
  bind_files(module);
  bind_skin(module);
  bind_scene(module);
  bind_report(module);
  bind_skin_solving(module);
  bind_solving(module);
  bind_check(module);
  bind_run(module);
  bind_survey(module);
  bind_sweep(module);
  bind_circuit(module);
  bind_calibration(module);
  bind_plan(module);
  bind_estimator(module);
  bind_sensors(module);
  bind_simulated_pad(module);
}
