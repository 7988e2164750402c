// A skin's scene put through all that it names.
#include "tactile_net/lab/skin_run.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <string>

#include "arrays.hpp"
#include "bound_experiment.hpp"
#include "contact_rows.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "skin_fields.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

lab::SkinExperiment run_skin(const SharedSkin& shared, std::optional<std::size_t> frame,
                             bool with_circuit, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  lab::SkinExperiment experiment =
      lab::run(frame ? at_frame(shared.scene(), *frame) : shared.scene(), {}, watcher);
  if (with_circuit) lab::run_circuit(experiment, *lab::make_simulator(), watcher);
  return experiment;
}

std::vector<double> listed(const std::array<double, 3>& values) {
  return {values.begin(), values.end()};
}

/// What the simulator has made of the circuit; None: nobody has asked.
std::optional<nb::typed<nb::dict, nb::str, nb::any>> network_of(const lab::SkinExperiment& self) {
  if (!self.network) return std::nullopt;
  const lab::SkinCircuitResult& result = *self.network;
  nb::typed<nb::dict, nb::str, nb::any> found;
  found["verdict"] = lab::name(result.verdict());
  found["relative"] = listed(result.relative);
  found["failure"] = result.refusal;
  found["alpha"] = result.circuit ? nb::cast(result.circuit->alpha().value) : nb::none();
  found["alpha_source"] =
      result.circuit ? nb::cast(lab::source(result.circuit->alpha())) : nb::none();
  found["tractions"] =
      result.relaxation ? nb::cast(owned(result.relaxation->tractions)) : nb::none();
  found["error_bound"] =
      result.relaxation ? nb::cast(result.relaxation->explained.total()) : nb::none();
  if (result.relaxation) {
    const SkinScene& own = std::get<SkinScene>(result.circuit->scene());
    const SurfaceGrid cells = grid(own);
    found["shape"] = nb::make_tuple(components(own), cells.rows, cells.columns);
    found["cell_area"] = cells.spacing_y * cells.spacing_z;
    if (const auto disagreement = result.relaxation->disagreement())
      found["failure"] = report::in_words(*disagreement);
  }
  return found;
}

}  // namespace

void bind_skin_run(nb::module_& module) {
  nb::class_<lab::SkinExperiment> experiment(module, "SkinExperiment");
  bind_what_experiments_share(experiment);
  experiment.def_prop_ro("refusal", [](const lab::SkinExperiment& self) { return self.refusal; })
      .def("truth", [](const lab::SkinExperiment& self) { return owned(self.frame.truth); })
      .def("relative", [](const lab::SkinExperiment& self) { return owned(listed(self.relative)); })
      .def("fields",
           [](const lab::SkinExperiment& self) {
             const std::size_t width = self.answer ? self.answer->tractions.size() : 0;
             return fields_of(self.answer ? Answers(&self.answer, 1) : Answers(), self.scene,
                              self.grid, width);
           })
      .def("patches",
           [](const lab::SkinExperiment& self) {
             return self.answer ? contact_rows(self.answer->patches) : std::vector<ContactRow>();
           })
      .def("network", &network_of)
      .def("remarks",
           [](const lab::SkinExperiment& self) { return report::remarks_in_words(self).all(); })
      .def("html", [](const lab::SkinExperiment& self) { return pages::run_page(self, "").html; });
  module.def("run_skin", &run_skin, nb::arg("scene"), nb::arg("frame").none(),
             nb::arg("with_circuit"), nb::arg("progress").none());
}

}  // namespace tactile_net::python
