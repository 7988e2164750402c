/// @file
/// The parts of the module, one file each.
#pragma once

#include <nanobind/nanobind.h>

namespace tactile_net::python {

void bind_errors();
void bind_option_words();
void bind_scene(nanobind::module_& module);
void bind_skin(nanobind::module_& module);
void bind_skin_solving(nanobind::module_& module);
void bind_files(nanobind::module_& module);
void bind_check(nanobind::module_& module);
void bind_solving(nanobind::module_& module);
void bind_report(nanobind::module_& module);
void bind_run(nanobind::module_& module);
void bind_survey(nanobind::module_& module);
void bind_sweep(nanobind::module_& module);
void bind_circuit(nanobind::module_& module);
void bind_calibration(nanobind::module_& module);
void bind_plan(nanobind::module_& module);
void bind_estimator(nanobind::module_& module);
void bind_sensors(nanobind::module_& module);
void bind_simulated_pad(nanobind::module_& module);

}  // namespace tactile_net::python
