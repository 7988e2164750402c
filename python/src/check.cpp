// A recording looked at before it is trusted.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/report/json/check_json.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

/// @param times     of the frames [s], NaN where one has none; empty: they have none
/// @param readings  frames x readings; NaN: missing
template <class Any>
lab::ReadingsCheck check(const Any& shared, const std::vector<double>& times, const Rows& readings,
                         const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  lab::ReadingsChecker checker(shared.scene());
  for (std::size_t i = 0; i < readings.shape(0); ++i) {
    watcher.frame();
    const bool timed = !times.empty() && !std::isnan(times[i]);
    checker.add(timed ? std::optional(times[i]) : std::nullopt, row(readings, i));
  }
  return checker.result(watcher);
}

std::string check_text(const lab::ReadingsCheck& self) {
  std::ostringstream out;
  report::print_check(out, self);
  return out.str();
}

template <class Any>
void bind_check_of(nb::module_& module) {
  module.def("check", &check<Any>, nb::arg("scene"), nb::arg("times"),
             nb::arg("readings").noconvert(), nb::arg("progress").none());
}

}  // namespace

void bind_check(nb::module_& module) {
  nb::class_<lab::ReadingsCheck>(module, "ReadingsCheck")
      .def("understood", &report::understood_in_words)
      .def("text", &check_text)
      .def("json", &report::check_json, nb::arg("name"));
  bind_check_of<SharedScene>(module);
  bind_check_of<SharedSkin>(module);
}

}  // namespace tactile_net::python
