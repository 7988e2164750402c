// A scene's circuit: its deck, and what can be said of it before it is built.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <sstream>
#include <utility>
#include <variant>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/pages/certificate_page.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/deck_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

std::string certificate_text(const lab::Certification& self) {
  std::ostringstream out;
  report::print_certificate(out, self);
  return out.str();
}

template <class Any>
lab::Certification certify(const Any& shared, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  return lab::certify(shared.scene(), watcher);
}

template <class Any>
std::string netlist(const Any& shared) {
  const nb::gil_scoped_release released;
  return report::deck_text(lab::simulated_circuit(shared.scene()), Answer::printed);
}

/// What ngspice made of a scene's circuit.
struct ScenesRelaxation {
  AnyScene scene;       // as it was given
  AnyScene of_circuit;  // with the surface that the nodes stand for
  lab::Relaxation relaxation;
};

template <class Any>
ScenesRelaxation relax(const Any& shared, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  const std::unique_ptr<Simulator> simulator = lab::make_simulator();
  const lab::SceneCircuit circuit = lab::simulated_circuit(shared.scene());
  return {shared.scene(), circuit.scene(), lab::relax(circuit, *simulator, watcher)};
}

/// y of the nodes' rows, and of a skin z of their columns; of a line none.
std::pair<Array, Array> places_of(const ScenesRelaxation& self) {
  std::vector<double> y;
  std::vector<double> z;
  if (const auto* line = std::get_if<Scene>(&self.of_circuit)) {
    y = positions(surface(*line));
  } else {
    const SurfaceGrid cells = grid(std::get<SkinScene>(self.of_circuit));
    for (std::size_t row = 0; row < cells.rows; ++row) y.push_back(cells.y(row));
    for (std::size_t column = 0; column < cells.columns; ++column) z.push_back(cells.z(column));
  }
  return {owned(std::move(y)), owned(std::move(z))};
}

std::string relaxation_text(const ScenesRelaxation& self) {
  std::ostringstream out;
  report::print_relaxation(out, self.relaxation);
  return out.str();
}

void write_certificate_report(const lab::Certification& self, const std::string& folder,
                              bool force) {
  const nb::gil_scoped_release released;
  write_page({.path = folder, .force = force},
             pages::certificate_html(self, {.files = {"certificate.json"}}), "certificate.json",
             report::certificate_json(self));
}

/// The circuit of a scene of a line, or of a skin.
template <class Any>
void bind_scenes(nb::module_& module) {
  module.def("relax", &relax<Any>, nb::arg("scene"), nb::arg("progress").none());
  module.def("certify", &certify<Any>, nb::arg("scene"), nb::arg("progress").none());
  module.def("netlist", &netlist<Any>, nb::arg("scene"));
}

}  // namespace

void bind_circuit(nb::module_& module) {
  nb::class_<lab::Certification>(module, "Certification")
      .def_prop_ro(
          "realization",
          [](const lab::Certification& self) { return name(self.certificate().realization); })
      .def_prop_ro(
          "stability",
          [](const lab::Certification& self) { return name(self.certificate().stability); })
      .def_prop_ro(
          "tolerance_margin",
          [](const lab::Certification& self) { return self.certificate().tolerance_margin; })
      .def_prop_ro("settling_seconds",
                   [](const lab::Certification& self) -> std::optional<double> {
                     const auto& dynamics = self.certificate().dynamics;
                     return dynamics ? dynamics->settling_seconds : std::nullopt;
                   })
      .def("text", &certificate_text)
      .def("json", &report::certificate_json)
      .def("report", &write_certificate_report, nb::arg("folder"), nb::arg("force"));
  nb::class_<ScenesRelaxation>(module, "Relaxation")
      .def_prop_ro("realization",
                   [](const ScenesRelaxation& self) { return name(self.relaxation.realization); })
      .def_prop_ro("agrees", [](const ScenesRelaxation& self) { return self.relaxation.agrees(); })
      .def_prop_ro("difference",
                   [](const ScenesRelaxation& self) { return self.relaxation.difference; })
      .def("voltages", [](const ScenesRelaxation& self) { return owned(self.relaxation.voltages); })
      .def("tractions",
           [](const ScenesRelaxation& self) { return owned(self.relaxation.tractions); })
      .def("places", &places_of)
      .def("text", &relaxation_text)
      .def("json", [](const ScenesRelaxation& self) {
        return report::relaxation_json(self.scene, self.relaxation);
      });
  bind_scenes<SharedScene>(module);
  bind_scenes<SharedSkin>(module);
}

}  // namespace tactile_net::python
