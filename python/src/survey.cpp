// What a scene's sensors can tell, of lines and of skins.
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <map>
#include <memory>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/identify.hpp"
#include "tactile_net/lab/skin_survey.hpp"
#include "tactile_net/pages/identify_page.hpp"
#include "tactile_net/pages/skin_survey_page.hpp"
#include "tactile_net/report/json/identify_json.hpp"
#include "tactile_net/report/json/skin_survey_json.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/skin_survey_words.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

/// A survey with the scene that it is of.
template <class Any, class Found>
struct ScenesSurvey {
  std::shared_ptr<Any> shared;
  Found survey;

  [[nodiscard]] const auto& scene() const noexcept { return shared->scene(); }
};
using LineSurvey = ScenesSurvey<SharedScene, lab::Survey>;
using SkinSurvey = ScenesSurvey<SharedSkin, lab::SkinSurvey>;

template <class Kind, class Any>
Kind identify(const std::shared_ptr<Any>& shared, std::optional<double> traction,
              std::optional<double> noise, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  return {shared,
          lab::identify(shared->scene(), {.traction = traction, .relative_noise = noise}, watcher)};
}

using Cells = std::vector<std::vector<std::string>>;

std::vector<std::string> words_of(const LineSurvey& self) {
  return report::verdict_in_words(self.survey, self.scene().units);
}
std::vector<std::string> words_of(const SkinSurvey& self) {
  return report::verdict_in_words(self.scene(), self.survey);
}

Cells cells_of(const LineSurvey& self) {
  return report::survey_cells(self.survey, self.scene().units);
}
Cells cells_of(const SkinSurvey& self) { return report::survey_cells(self.scene(), self.survey); }

std::optional<double> normal_of(const LineSurvey& self) { return self.survey.own.normal; }
std::optional<double> normal_of(const SkinSurvey& self) {
  return self.survey.own.resolvable(SkinRipple::pressure);
}

std::optional<double> tangential_of(const LineSurvey& self) { return self.survey.own.tangential; }
/// The coarser of both drags.
std::optional<double> tangential_of(const SkinSurvey& self) {
  const auto along = self.survey.own.resolvable(SkinRipple::drag_along);
  const auto across = self.survey.own.resolvable(SkinRipple::drag_across);
  return along && across ? std::optional(std::max(*along, *across)) : std::nullopt;
}

bool hides(const LineSurvey& self) { return lab::hides_anything(self.survey.own); }
bool hides(const SkinSurvey& self) {
  const auto& finite = self.survey.own.told.finite;
  return lab::hidden_waves(self.survey.own) > 0 || (finite && finite->hidden > 0);
}

/// By the part of a ripple: the shortest wavelength that is told of it.
std::map<std::string, std::optional<double>> wavelengths_of(const SkinSurvey& self) {
  const lab::SkinSensorChoice& own = self.survey.own;
  return {{"normal", own.resolvable(SkinRipple::pressure)},
          {"drag_along", own.resolvable(SkinRipple::drag_along)},
          {"drag_across", own.resolvable(SkinRipple::drag_across)}};
}

template <class Kind>
void write_survey_report(const Kind& self, const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  write_page({.path = folder, .force = force},
             pages::survey_html(self.scene(), self.survey, {.files = {"result.json"}}),
             "result.json", report::survey_json(self.scene(), self.survey));
}

template <class Kind>
void bind_what_surveys_share(nb::class_<Kind>& survey) {
  survey.def_prop_ro("normal", [](const Kind& self) { return normal_of(self); })
      .def_prop_ro("tangential", [](const Kind& self) { return tangential_of(self); })
      .def_prop_ro("hides", [](const Kind& self) { return hides(self); })
      .def("words", [](const Kind& self) { return words_of(self); })
      .def("cells", [](const Kind& self) { return cells_of(self); })
      .def("json", [](const Kind& self) { return report::survey_json(self.scene(), self.survey); })
      .def("report", &write_survey_report<Kind>, nb::arg("folder"), nb::arg("force"));
}

template <class Kind, class Any>
void bind_identify(nb::module_& module) {
  module.def("identify", &identify<Kind, Any>, nb::arg("scene"), nb::arg("traction").none(),
             nb::arg("noise").none(), nb::arg("progress").none());
}

}  // namespace

void bind_survey(nb::module_& module) {
  nb::class_<LineSurvey> line(module, "Survey");
  bind_what_surveys_share(line);
  nb::class_<SkinSurvey> skin(module, "SkinSurvey");
  bind_what_surveys_share(skin);
  skin.def("wavelengths", &wavelengths_of).def("shares", [](const SkinSurvey& self) {
    return report::share_cells(self.scene(), self.survey);
  });
  bind_identify<LineSurvey, SharedScene>(module);
  bind_identify<SkinSurvey, SharedSkin>(module);
}

}  // namespace tactile_net::python
