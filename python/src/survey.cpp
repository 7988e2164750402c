// What a scene's sensors can tell, of lines and of skins.
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <map>
#include <variant>

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
  std::variant<ScenePointer, SkinPointer> shared;
  lab::Survey survey;

  /// Of `call(scene)`.
  auto with_scene(const auto& call) const {
    return std::visit([&](const auto& one) { return call(one->scene()); }, shared);
  }
  [[nodiscard]] std::optional<Units> units() const {
    return with_scene([](const auto& scene) { return scene.units; });
  }
  [[nodiscard]] std::string json() const {
    return with_scene([&](const auto& scene) { return report::survey_json(scene, survey); });
  }
};

ScenesSurvey survey_of(const std::variant<ScenePointer, SkinPointer>& shared,
                       std::optional<double> traction, std::optional<double> noise,
                       const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  return {shared, std::visit(
                      [&](const auto& one) {
                        return lab::identify(
                            one->scene(), {.traction = traction, .relative_noise = noise}, watcher);
                      },
                      shared)};
}

/// By the part of a ripple: the shortest wavelength that is told of it.
std::map<std::string, std::optional<double>> wavelengths_of(const ScenesSurvey& self) {
  const lab::SensorChoice& own = self.survey.own;
  std::map<std::string, std::optional<double>> all = {
      {"normal", own.resolvable(SkinRipple::pressure)},
      {"drag_along", own.resolvable(SkinRipple::drag_along)}};
  if (self.survey.is_skin()) all["drag_across"] = own.resolvable(SkinRipple::drag_across);
  return all;
}

void write_survey_report(const ScenesSurvey& self, const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  write_page({.path = folder, .force = force}, self.with_scene([&](const auto& scene) {
    return pages::survey_html(scene, self.survey, {.files = {"result.json"}});
  }),
             "result.json", self.json());
}

}  // namespace

void bind_survey(nb::module_& module) {
  nb::class_<ScenesSurvey>(module, "Survey")
      .def_prop_ro(
          "normal",
          [](const ScenesSurvey& self) { return self.survey.own.resolvable(SkinRipple::pressure); })
      .def_prop_ro("tangential",
                   [](const ScenesSurvey& self) { return lab::resolvable_drag(self.survey.own); })
      .def_prop_ro("hides",
                   [](const ScenesSurvey& self) { return lab::hides_anything(self.survey.own); })
      .def("wavelengths", &wavelengths_of)
      .def("words",
           [](const ScenesSurvey& self) {
             return report::verdict_in_words(self.survey, self.units());
           })
      .def("cells",
           [](const ScenesSurvey& self) { return report::survey_cells(self.survey, self.units()); })
      .def("shares",
           [](const ScenesSurvey& self) { return report::share_cells(self.survey, self.units()); })
      .def("json", &ScenesSurvey::json)
      .def("report", &write_survey_report, nb::arg("folder"), nb::arg("force"));
  module.def("identify", &survey_of, nb::arg("scene"), nb::arg("traction").none(),
             nb::arg("noise").none(), nb::arg("progress").none());
}

}  // namespace tactile_net::python
