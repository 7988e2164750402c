/// @file
/// What scenes of lines and of skins have in common for Python.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "read_frames.hpp"
#include "simulated_frames.hpp"
#include "tactile_net/report/words/workload_words.hpp"

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

/// t, readings, the true tractions of every frame, and what the effects have to say.
template <class Any>
std::tuple<Array, Array, Array, std::vector<std::string>> simulate(const Any& self,
                                                                   const nb::object& progress) {
  SimulatedFrames all;
  Watcher watcher(progress);
  {
    const nb::gil_scoped_release released;
    all = simulated_frames(self.scene(), watcher);
  }
  const std::size_t frames = all.count();
  const std::size_t width = all.truth.size() / std::max<std::size_t>(frames, 1);
  return {owned(std::move(all.t)),
          owned(std::move(all.readings), {frames, reading_count(self.scene().sensor)}),
          owned(std::move(all.truth), {frames, width}), std::move(all.notes)};
}

/// K: neither weighted by the noise nor with dead taxels left out.
template <class Any>
Array kernel_matrix(const Any& self) {
  Matrix kernel;
  {
    const nb::gil_scoped_release released;
    kernel = plain_kernel(self.scene());
  }
  return as_array(std::move(kernel));
}

/// Name, whether it is simulated, and what it does or its absence saves.
template <class Any>
std::vector<std::tuple<std::string, bool, std::string>> effects_of(const Any& self) {
  std::vector<std::tuple<std::string, bool, std::string>> all;
  for (const lab::Workload::Effect& effect : lab::workload(self.scene()).effects)
    all.emplace_back(effect.row->name, effect.simulated,
                     report::effect_in_words(effect, self.scene()));
  return all;
}

template <class Any>
std::string explain(const Any& self) {
  std::ostringstream text;
  report::print_workload(text, self.scene(), lab::workload(self.scene()));
  return text.str();
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
      .def("simulate", &simulate<Any>, nb::arg("progress").none())
      .def("kernel_matrix", &kernel_matrix<Any>)
      .def("normal_matrix", &normal_matrix_of<Any>, nb::arg("alpha"))
      .def("effects", &effects_of<Any>)
      .def("explain", &explain<Any>);
}

}  // namespace tactile_net::python
