// Many recordings side by side.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/report/recordings.hpp"

namespace tactile_net::python {
namespace {

namespace nb = nanobind;

/// As JSON and as CSV, the most suspicious first.
template <class Any>
std::pair<std::string, std::string> told(const Any& shared, std::vector<lab::RecordingRow> rows) {
  lab::sort_by_suspicion(rows);
  const AnyScene scene = shared.scene();
  return {report::recordings_json(rows, scene), report::recordings_csv(rows, scene)};
}

template <class Any>
void bind_report_of(nb::module_& module) {
  module.def("report", &told<Any>, nb::arg("scene"), nb::arg("rows"));
}

/// @param line  0: the file as a whole
lab::RecordingRow failed_row(const std::string& name, std::size_t line, const std::string& message,
                             const std::string& hint) {
  return {.name = name,
          .problem = report::problem_in_words({.line = line, .message = message, .hint = hint})};
}

}  // namespace

void bind_report(nb::module_& module) {
  nb::class_<lab::RecordingRow>(module, "RecordingRow")
      .def_rw("seconds", &lab::RecordingRow::seconds);
  module.def("failed_row", &failed_row, nb::arg("name"), nb::arg("line"), nb::arg("message"),
             nb::arg("hint"));
  bind_report_of<SharedScene>(module);
  bind_report_of<SharedSkin>(module);
}

}  // namespace tactile_net::python
