// A scene's depth, layer, moduli and gains from a log of presses.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>

#include "page_folder.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/frames/press_log_file.hpp"
#include "tactile_net/lab/calibrate.hpp"
#include "tactile_net/pages/calibration_page.hpp"
#include "tactile_net/report/json/calibration_json.hpp"
#include "tactile_net/report/words/calibration_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

/// A calibration with the scene's text, which it is written into, and the log's name.
struct ScenesCalibration {
  std::string text;
  lab::SceneCalibration found;
  std::string log;
  std::vector<std::string> notes;
};

PadParameter parameter_of(const std::string& text) {
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (name(static_cast<PadParameter>(i)) == text) return static_cast<PadParameter>(i);
  throw nb::value_error(("there is no parameter " + text).c_str());
}

/// @tparam Kind  of a line or a skin
template <class Kind>
ScenesCalibration calibrate(const std::shared_ptr<Shared<Kind>>& shared, const std::string& log,
                            bool robust, std::size_t next, const std::optional<std::string>& target,
                            const std::vector<std::string>& fixed, const nb::object& progress) {
  CalibrationOptions options = parse_calibration_options(shared->text(), shared->file());
  options.robust = robust;
  options.profile = true;
  for (const std::string& text : fixed) options.set_sd(parameter_of(text), 0.0);
  std::optional<PadParameter> aim;
  if (target) aim = parameter_of(*target);
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  frames::PressLogFile file = frames::read_press_log(log, shared->scene(), options);
  ScenesCalibration result{.text = shared->text(),
                           .found = lab::calibrate(shared->scene(), std::move(file.log), options,
                                                   [&](std::size_t) { watcher.frame(); }),
                           .log = std::filesystem::path(log).filename().string(),
                           .notes = std::move(file.notes)};
  if (next > 0 || aim) lab::plan_presses(result.found, std::max<std::size_t>(next, 1), aim);
  return result;
}

/// @param forced  the fit may have failed
std::string calibrated(const ScenesCalibration& self, bool forced) {
  if (self.found.fit.verdict != FitVerdict::ok && !forced)
    throw std::domain_error(report::calibration_in_words(self.found).front());
  const nb::gil_scoped_release released;
  return calibrated_scene(self.text, self.found.scene, self.found.log, self.found.fit, self.log);
}

std::string html(const ScenesCalibration& self) {
  return pages::calibration_html(self.found, self.log, {}).html;
}

void write_calibration_report(const ScenesCalibration& self, const std::string& folder,
                              bool force) {
  const nb::gil_scoped_release released;
  write_page({.path = folder, .force = force},
             pages::calibration_html(self.found, self.log, {.files = {"result.json"}}),
             "result.json", report::calibration_json(self.found, self.log));
}

}  // namespace

void bind_calibration(nb::module_& module) {
  nb::class_<ScenesCalibration>(module, "Calibration")
      .def_ro("notes", &ScenesCalibration::notes)
      .def("words",
           [](const ScenesCalibration& self) { return report::calibration_in_words(self.found); })
      .def("hidden",
           [](const ScenesCalibration& self) {
             return report::null_directions_in_words(self.found);
           })
      .def("cells",
           [](const ScenesCalibration& self) { return report::calibration_cells(self.found); })
      .def("next_cells",
           [](const ScenesCalibration& self) { return report::next_press_cells(self.found); })
      .def("json",
           [](const ScenesCalibration& self) {
             return report::calibration_json(self.found, self.log);
           })
      .def("html", &html)
      .def("calibrated", &calibrated, nb::arg("forced"))
      .def("report", &write_calibration_report, nb::arg("folder"), nb::arg("force"));
  const auto define = [&](auto function) {
    module.def("calibrate", function, nb::arg("scene"), nb::arg("log"), nb::arg("robust"),
               nb::arg("next"), nb::arg("target").none(), nb::arg("fixed"),
               nb::arg("progress").none());
  };
  define(&calibrate<lab::SceneProblem>);
  define(&calibrate<lab::SkinSceneProblem>);
}

}  // namespace tactile_net::python
