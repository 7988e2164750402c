/// @file
/// What scenes of lines and of skins have in common for Python.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "read_frames.hpp"

namespace tactile_net::python {

/// P of the scene's problem.
template <class Any>
Array normal_matrix_of(Any& self, double alpha) {
  Matrix matrix;
  {
    const nb::gil_scoped_release released;
    const auto locked = self.lock();
    matrix = normal_matrix(locked.problem.problem(), alpha);
  }
  return as_array(std::move(matrix));
}

/// @tparam Any  `SharedScene` or `SharedSkin`
template <class Any>
void bind_what_scenes_share(nb::class_<Any>& scene) {
  scene.def_prop_ro("text", &Any::text)
      .def_prop_ro("file", &Any::file)
      .def_prop_ro("title", [](const Any& self) { return self.scene().title; })
      .def_prop_ro("readings", [](const Any& self) { return reading_count(self.scene().sensor); })
      .def_prop_ro("even", [](const Any& self) { return is_even(self.scene().sensor); })
      .def_prop_ro("channels",
                   [](const Any& self) {
                     std::vector<std::string> names;
                     for (const auto& channel : channels(self.scene().sensor))
                       names.push_back(channel.name);
                     return names;
                   })
      .def_prop_ro("reading_names",
                   [](const Any& self) { return reading_names(self.scene().sensor); })
      .def_prop_ro("timing",
                   [](const Any& self) -> std::optional<std::pair<double, std::size_t>> {
                     if (!self.scene().time) return std::nullopt;
                     return std::pair(self.scene().time->rate, self.scene().time->frames);
                   })
      .def_prop_ro("si", [](const Any& self) { return self.scene().units.has_value(); })
      .def("read", &read<Any>, nb::arg("path"), nb::arg("columns"), nb::arg("accept_missing"))
      .def("take", &take<Any>, nb::arg("npy"))
      .def("raw_numbers", &raw<Any>, nb::arg("readings").noconvert())
      .def("normal_matrix", &normal_matrix_of<Any>, nb::arg("alpha"));
}

}  // namespace tactile_net::python
