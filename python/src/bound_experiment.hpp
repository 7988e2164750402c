/// @file
/// What experiments with lines and with skins have in common for Python.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <sstream>
#include <string>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "tactile_net/pages/run_page.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/json/skin_json.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::python {

template <class Any>
std::string experiment_text(const Any& self) {
  std::ostringstream out;
  report::print_experiment(out, self);
  return out.str();
}

template <class Any>
void write_experiment_report(const Any& self, const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  write_page({.path = folder, .force = force}, pages::run_page(self, ""), "result.json",
             report::experiment_json(self));
}

/// @tparam Any  `lab::Experiment` or `lab::SkinExperiment`
template <class Any>
void bind_what_experiments_share(nb::class_<Any>& experiment) {
  experiment.def_prop_ro("succeeded", &Any::succeeded)
      .def("readings", [](const Any& self) { return owned(self.frame.readings); })
      .def("text", &experiment_text<Any>)
      .def("json", [](const Any& self) { return report::experiment_json(self); })
      .def("report", &write_experiment_report<Any>, nb::arg("folder"), nb::arg("force"));
}

}  // namespace tactile_net::python
