// Readings into tractions.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <stdexcept>

#include "bad_frame.hpp"
#include "missing_named.hpp"
#include "rooms.hpp"
#include "solved_recording.hpp"
#include "solver.hpp"
#include "tactile_net/report/json/contacts_json.hpp"
#include "tactile_net/report/words/data_words.hpp"

namespace tactile_net::python {

Array Solver::solve(const Rows& readings) {
  const std::size_t frames = readings.shape(0);
  std::vector<double> tractions(frames * tractions_);
  {
    Watcher watcher;
    const nb::gil_scoped_release released;
    for (std::size_t i = 0; i < frames; ++i) {
      watcher.frame();
      const std::span answer(tractions.data() + i * tractions_, tractions_);
      const auto locked = shared_->lock();
      const lab::FrameResult result = solver_->solve(row(readings, i), answer);
      if (result.status != FrameStatus::ok) throw bad_frame(result.status, row(readings, i), i);
    }
  }
  return owned(std::move(tractions), {frames, tractions_});
}

View Solver::matrix(nb::handle owner) const {
  const Reconstruction* product = solver_->product();
  if (product == nullptr)
    throw std::invalid_argument(
        "the answer is not one matrix here: that takes tikhonov or closed_form, a given alpha and "
        "tangential weight, no constraints, and less than 1024 tractions");
  const Matrix& transposed = product->transposed();
  const auto row = static_cast<std::int64_t>(transposed.columns);
  return {transposed.values.data(), {transposed.columns, transposed.rows}, owner, {1, row}};
}

namespace {

Method method_of(const std::string& name) {
  if (const auto method = method_named(name)) return *method;
  throw std::invalid_argument("there is no method '" + name +
                              "': dft, tikhonov, closed_form or network");
}

std::shared_ptr<SolvedRecording> solve(const ScenePointer& shared, const std::string& method,
                                       const std::string& missing,
                                       std::optional<std::size_t> share_alpha,
                                       const std::vector<double>& times, const Rows& readings,
                                       const nb::object& progress) {
  Watcher watcher(progress);
  const lab::RecordingSolverOptions options{.missing = missing_of(missing),
                                            .share_alpha = share_alpha};
  const Method chosen = method_of(method);
  const nb::gil_scoped_release released;
  return std::make_shared<SolvedRecording>(shared, chosen, options, times, readings, watcher);
}

/// One value a frame, of those that have an answer; else `none`.
template <class Value, class Of>
std::vector<Value> of_frames(const SolvedRecording& self, Value none, Of of) {
  std::vector<Value> all;
  for (const auto& result : self.results()) all.push_back(result ? of(*result) : none);
  return all;
}

Array alphas(const SolvedRecording& self) {
  return owned(of_frames(self, unknown, [](const lab::FrameResult& result) {
    return result.alpha ? result.alpha->value : unknown;
  }));
}

std::vector<std::string> verdicts(const SolvedRecording& self) {
  return of_frames(self, std::string("missing"), [](const lab::FrameResult& result) {
    return std::string(lab::name(result.verdict));
  });
}

std::vector<std::string> data(const SolvedRecording& self) {
  return of_frames(self, std::string("missing"), [](const lab::FrameResult& result) {
    return result.data ? report::data_word(*result.data) : std::string("not_judged");
  });
}

/// Deviation, normal force, tangential force, centre, contacts as JSON; None: the method has none.
std::optional<std::tuple<Array, Array, Array, Array, std::string>> bands_of(SolvedRecording& self) {
  Watcher watcher;
  std::optional<Bands> bands;
  {
    const nb::gil_scoped_release released;
    if (self.has_bands()) bands = self.bands(watcher);
  }
  if (!bands) return std::nullopt;
  const std::size_t frames = self.frames();
  return std::tuple(owned(std::move(bands->deviation), {frames, self.width()}),
                    owned(std::move(bands->normal_force), {frames, 2}),
                    owned(std::move(bands->tangential_force), {frames, 2}),
                    owned(std::move(bands->centre), {frames, 2}),
                    report::contacts_json(bands->patches, false));
}

std::string json_of(SolvedRecording& self, const std::string& name) {
  Watcher watcher;
  const nb::gil_scoped_release released;
  return self.json(name, watcher);
}

void write_recording_report(SolvedRecording& self, const std::string& folder, bool force,
                            const std::string& name) {
  Watcher watcher;
  const nb::gil_scoped_release released;
  self.report({.path = folder, .force = force}, name, watcher);
}

}  // namespace

void bind_solving(nb::module_& module) {
  nb::class_<Solver>(module, "Solver")
      .def(
          "__init__",
          [](Solver* self, const ScenePointer& scene, const std::string& method,
             std::optional<double> alpha) {
            const Method chosen = method_of(method);
            const nb::gil_scoped_release released;
            new (self) Solver(scene, chosen, alpha);
          },
          nb::arg("scene"), nb::arg("method"), nb::arg("alpha").none())
      .def_prop_ro("tractions", &Solver::tractions)
      .def_prop_ro("matrix",
                   [](nb::handle self) { return nb::cast<const Solver&>(self).matrix(self); })
      .def("solve", &Solver::solve, nb::arg("readings").noconvert());
  nb::class_<SolvedRecording>(module, "SolvedRecording")
      .def("tractions",
           [](const SolvedRecording& self) {
             return owned(self.tractions(), {self.frames(), self.width()});
           })
      .def("alpha", &alphas)
      .def("verdict", &verdicts)
      .def("data", &data)
      .def("notes", &SolvedRecording::notes)
      .def("bands", &bands_of)
      .def("json", &json_of, nb::arg("name"))
      .def(
          "row",
          [](const SolvedRecording& self, const std::string& name) {
            Watcher watcher;
            const nb::gil_scoped_release released;
            return self.row(name, watcher);
          },
          nb::arg("name"))
      .def("report", &write_recording_report, nb::arg("folder"), nb::arg("force"), nb::arg("name"));
  module.def("solve", &solve, nb::arg("scene"), nb::arg("method"), nb::arg("missing"),
             nb::arg("share_alpha").none(), nb::arg("times"), nb::arg("readings").noconvert(),
             nb::arg("progress").none());
}

}  // namespace tactile_net::python
