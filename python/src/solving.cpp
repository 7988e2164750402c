// Readings into tractions.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <stdexcept>

#include "bad_frame.hpp"
#include "missing_named.hpp"
#include "rooms.hpp"
#include "skin_fields.hpp"
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
        "the answer is not one matrix here: that takes tikhonov or "
        "closed_form, a given alpha and "
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

std::shared_ptr<SolvedRecording> solve(const AnyPointer& shared, const std::string& method,
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
  for (const auto& answer : self.answers()) all.push_back(answer ? of(*answer) : none);
  return all;
}

Array tractions(const SolvedRecording& self) {
  std::vector<double> all;
  all.reserve(self.frames() * self.width());
  for (const auto& answer : self.answers())
    if (answer)
      all.insert(all.end(), answer->tractions.begin(), answer->tractions.end());
    else
      all.insert(all.end(), self.width(), unknown);
  return owned(std::move(all), {self.frames(), self.width()});
}

Array alphas(const SolvedRecording& self) {
  return owned(of_frames(self, unknown, [](const lab::FrameAnswer& answer) {
    return answer.alpha.value > 0.0 ? answer.alpha.value : unknown;
  }));
}

std::vector<std::string> verdicts(const SolvedRecording& self) {
  return of_frames(self, std::string("missing"), [](const lab::FrameAnswer& answer) {
    return std::string(lab::name(answer.verdict));
  });
}

std::vector<std::string> data(const SolvedRecording& self) {
  return of_frames(self, std::string("missing"), [](const lab::FrameAnswer& answer) {
    return answer.data ? report::data_word(*answer.data) : std::string("not_judged");
  });
}

/// Of a line: deviation, normal force, tangential force, centre, contacts as JSON, verdicts; None:
/// the method has none.
std::optional<std::tuple<Array, Array, Array, Array, std::string, std::vector<std::string>>>
bands_of(SolvedRecording& self) {
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
                    report::contacts_json(bands->patches, false), std::move(bands->verdicts));
}

/// Of a skin, whose answers have them at once, as JSON.
std::string patches_of(const SolvedRecording& self) {
  std::vector<std::optional<std::vector<ContactPatch>>> frames;
  for (const auto& answer : self.answers())
    frames.push_back(answer ? std::optional(answer->patches) : std::nullopt);
  return report::contacts_json(frames, true);
}

Array quantiles_of(const SolvedRecording& self, const std::string& what,
                   const std::vector<double>& probabilities) {
  Watcher watcher;
  std::vector<double> all;
  {
    const nb::gil_scoped_release released;
    all = self.quantiles(what, probabilities, watcher);
  }
  return owned(std::move(all), {self.frames(), self.directions(what), probabilities.size()});
}

/// A call of `SolvedRecording` that may take long: Ctrl-C ends it, other threads run on.
template <auto call>
auto watched(const SolvedRecording& self, const std::string& name) {
  Watcher watcher;
  const nb::gil_scoped_release released;
  return (self.*call)(name, watcher);
}

using ByName = std::string (SolvedRecording::*)(const std::string&, Watcher&) const;

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
      .def("tractions", &tractions)
      .def("alpha", &alphas)
      .def("verdict", &verdicts)
      .def("data", &data)
      .def("notes", &SolvedRecording::notes, nb::call_guard<nb::gil_scoped_release>())
      .def("bands", &bands_of)
      .def("quantiles", &quantiles_of, nb::arg("what"), nb::arg("probabilities"))
      .def(
          "fields",
          [](const SolvedRecording& self, const std::vector<std::string>& wrench) {
            return fields_of(self.answers(), self.skin(), self.grid(), self.width(), wrench);
          },
          nb::arg("wrench"))
      .def("uncertainty",
           [](const SolvedRecording& self) { return uncertainty_of(self.answers(), self.skin()); })
      .def("patches", &patches_of)
      .def("json", &watched<static_cast<ByName>(&SolvedRecording::json)>, nb::arg("name"))
      .def("row", &watched<&SolvedRecording::row>, nb::arg("name"))
      .def("html", &watched<&SolvedRecording::html>, nb::arg("name"))
      .def(
          "report",
          [](const SolvedRecording& self, const std::string& folder, bool force,
             const std::string& name) {
            Watcher watcher;
            const nb::gil_scoped_release released;
            self.report({.path = folder, .force = force}, name, watcher);
          },
          nb::arg("folder"), nb::arg("force"), nb::arg("name"));
  module.def("solve", &solve, nb::arg("scene"), nb::arg("method"), nb::arg("missing"),
             nb::arg("share_alpha").none(), nb::arg("times"), nb::arg("readings").noconvert(),
             nb::arg("progress").none());
}

}  // namespace tactile_net::python
