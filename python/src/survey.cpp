// What a scene's sensors can tell.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/identify.hpp"
#include "tactile_net/pages/identify_page.hpp"
#include "tactile_net/report/json/identify_json.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

/// A survey with the scene that it is of.
struct ScenesSurvey {
  ScenePointer shared;
  lab::Survey survey;

  [[nodiscard]] const Scene& scene() const noexcept { return shared->scene(); }
};

ScenesSurvey identify(const ScenePointer& shared, std::optional<double> traction,
                      std::optional<double> noise, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  return {shared,
          lab::identify(shared->scene(), {.traction = traction, .relative_noise = noise}, watcher)};
}

std::string report_of(const ScenesSurvey& self, const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  return write_page({.path = folder, .force = force},
                    pages::survey_html(self.scene(), self.survey, {.files = {"result.json"}}),
                    "result.json", report::survey_json(self.scene(), self.survey));
}

}  // namespace

void bind_survey(nb::module_& module) {
  nb::class_<ScenesSurvey>(module, "Survey")
      .def_prop_ro("normal", [](const ScenesSurvey& self) { return self.survey.own.normal; })
      .def_prop_ro("tangential",
                   [](const ScenesSurvey& self) { return self.survey.own.tangential; })
      .def_prop_ro("hides",
                   [](const ScenesSurvey& self) { return lab::hides_anything(self.survey.own); })
      .def("words",
           [](const ScenesSurvey& self) {
             return report::verdict_in_words(self.survey, self.scene().units);
           })
      .def("cells",
           [](const ScenesSurvey& self) {
             return pages::survey_cells(self.survey, self.scene().units);
           })
      .def("json",
           [](const ScenesSurvey& self) { return report::survey_json(self.scene(), self.survey); })
      .def("report", &report_of, nb::arg("folder"), nb::arg("force"));
  module.def("identify", &identify, nb::arg("scene"), nb::arg("traction").none(),
             nb::arg("noise").none(), nb::arg("progress").none());
}

}  // namespace tactile_net::python
