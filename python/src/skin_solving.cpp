// A skin's readings into tractions: one frame, many, and a scene put through all that it names.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "bad_frame.hpp"
#include "rooms.hpp"
#include "solved_skin.hpp"
#include "tactile_net/lab/skin_run.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/skin_json.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::python {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Tikhonov's method for any number of frames.
class SkinSolver {
 public:
  SkinSolver(SkinPointer shared, std::optional<double> alpha) : shared_(std::move(shared)) {
    const auto locked = shared_->lock();
    problem_.emplace(locked.problem);
    if (alpha) {
      SkinScene scene = locked.problem.scene();
      scene.reconstruct.alpha = *alpha;
      problem_.emplace(std::move(scene));
    }
    const auto& given = problem_->scene().reconstruct.alpha;
    if (given && !problem_->constraints())
      product_.emplace(problem_->family().reconstruction(*given));
  }

  [[nodiscard]] std::size_t tractions() const { return problem_->tractions(); }

  [[nodiscard]] View matrix(nb::handle owner) const {
    if (!product_)
      throw std::invalid_argument(
          "the answer is not one matrix here: that takes a given alpha and no constraints");
    const Matrix& transposed = product_->transposed();
    const auto row = static_cast<std::int64_t>(transposed.columns);
    return {transposed.values.data(), {transposed.columns, transposed.rows}, owner, {1, row}};
  }

  [[nodiscard]] Array solve(const Rows& readings) {
    const std::size_t frames = readings.shape(0);
    std::vector<double> tractions;
    tractions.reserve(frames * problem_->tractions());
    {
      Watcher watcher;
      const nb::gil_scoped_release released;
      const auto locked = shared_->lock();  // what follows from a scene is shared, and made once
      for (std::size_t i = 0; i < frames; ++i) {
        watcher.frame();
        const std::vector<double> answer = one(row(readings, i), i);
        tractions.insert(tractions.end(), answer.begin(), answer.end());
      }
    }
    return owned(std::move(tractions), {frames, problem_->tractions()});
  }

 private:
  /// The same tractions as `lab::solve`'s, and where alpha is given without the bands.
  [[nodiscard]] std::vector<double> one(std::span<const double> readings, std::size_t frame) const {
    if (!product_) return answer_of(*problem_, readings, frame).tractions;
    for (const double reading : readings)
      if (!std::isfinite(reading)) throw bad_frame(FrameStatus::not_finite, readings, frame);
    const SkinFamily& family = problem_->family();
    std::vector<double> found =
        family.solve(family.analyse(readings), *problem_->scene().reconstruct.alpha);
    if (!std::all_of(found.begin(), found.end(), [](double f) { return std::isfinite(f); }))
      throw bad_frame(FrameStatus::too_large, readings, frame);
    return found;
  }

  SkinPointer shared_;
  std::optional<lab::SkinSceneProblem> problem_{};
  std::optional<Reconstruction> product_{};
};

std::shared_ptr<SolvedSkin> solve(const SkinPointer& shared, const std::vector<double>& times,
                                  const Rows& readings, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  return std::make_shared<SolvedSkin>(shared, times, readings, watcher);
}

using Answers = std::span<const lab::SkinAnswer>;

/// `size` values of every answer, one answer a row.
template <class Of>
Array rows_of(Answers answers, std::size_t size, Of of) {
  std::vector<double> all;
  all.reserve(answers.size() * size);
  for (const lab::SkinAnswer& answer : answers) {
    const auto& values = of(answer);
    all.insert(all.end(), values.begin(), values.end());
    all.resize((all.size() + size - 1) / size * size, unknown);
  }
  all.resize(answers.size() * size, unknown);
  return owned(std::move(all), {answers.size(), size});
}

/// Components x cells, as `deviations` too.
Array tractions_of(Answers answers, std::size_t width) {
  return rows_of(
      answers, width, [](const auto& one) -> const auto& { return one.tractions; });
}

Array deviations_of(Answers answers, std::size_t width) {
  return rows_of(answers, width, [&](const lab::SkinAnswer& one) {
    return one.deviations.empty() ? std::vector<double>(width, unknown) : one.deviations;
  });
}

/// 1 for a cell that touches, else 0.
Array touching_of(Answers answers, const SkinGrid& grid) {
  return rows_of(answers, grid.count(), [&](const lab::SkinAnswer& one) {
    std::vector<double> cells(grid.count());
    for (const std::size_t cell : one.cells) cells[cell] = 1.0;
    return cells;
  });
}

/// The columns of `report::wrench_columns`.
Array wrenches_of(Answers answers) {
  return rows_of(answers, report::wrench_columns().size(), &report::wrench_values);
}

Array covariances_of(Answers answers) {
  return rows_of(
      answers, 36, [](const auto& one) -> const auto& { return one.wrench.covariance; });
}

/// Radius, second radius and angle of the strongest contact, each with its deviation.
Array ellipses_of(Answers answers) {
  return rows_of(answers, 6, [](const lab::SkinAnswer& one) {
    if (!one.ellipse) return std::vector<double>(6, unknown);
    const ContactEllipse& found = *one.ellipse;
    return std::vector{found.radius.value,        found.radius.deviation,
                       found.second_radius.value, found.second_radius.deviation,
                       found.angle.value,         found.angle.deviation};
  });
}

/// What Python makes its arrays of.
nb::typed<nb::dict, nb::str, nb::any> fields_of(Answers answers, const SkinGrid& grid,
                                                std::size_t width) {
  nb::typed<nb::dict, nb::str, nb::any> found;
  std::vector<std::string> verdicts;
  std::vector<std::string> sources;
  std::vector<double> alphas;
  std::vector<std::size_t> contacts;
  for (const lab::SkinAnswer& answer : answers) {
    verdicts.emplace_back(lab::name(answer.verdict));
    sources.emplace_back(lab::source(answer.alpha));
    alphas.push_back(answer.alpha.value);
    contacts.push_back(answer.contacts);
  }
  found["tractions"] = tractions_of(answers, width);
  found["deviation"] = deviations_of(answers, width);
  found["touching"] = touching_of(answers, grid);
  found["wrench"] = wrenches_of(answers);
  found["covariance"] = covariances_of(answers);
  found["ellipse"] = ellipses_of(answers);
  found["verdict"] = verdicts;
  found["alpha"] = owned(std::move(alphas));
  found["alpha_source"] = sources;
  found["contacts"] = contacts;
  return found;
}

lab::SkinExperiment run(const SharedSkin& shared, std::optional<std::size_t> frame,
                        const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  return lab::run(frame ? at_frame(shared.scene(), *frame) : shared.scene(), {}, watcher);
}

std::string text(const lab::SkinExperiment& self) {
  std::ostringstream out;
  report::print_experiment(out, self);
  return out.str();
}

std::string report_of(const lab::SkinExperiment& self, const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  return write_page({.path = folder, .force = force}, pages::run_page(self, ""), "result.json",
                    report::experiment_json(self));
}

void bind_solver(nb::module_& module) {
  nb::class_<SkinSolver>(module, "SkinSolver")
      .def(
          "__init__",
          [](SkinSolver* self, const SkinPointer& scene, std::optional<double> alpha) {
            const nb::gil_scoped_release released;
            new (self) SkinSolver(scene, alpha);
          },
          nb::arg("scene"), nb::arg("alpha").none())
      .def_prop_ro("tractions", &SkinSolver::tractions)
      .def_prop_ro("matrix",
                   [](nb::handle self) { return nb::cast<const SkinSolver&>(self).matrix(self); })
      .def("solve", &SkinSolver::solve, nb::arg("readings").noconvert());
}

}  // namespace

void bind_skin_solving(nb::module_& module) {
  bind_solver(module);
  nb::class_<SolvedSkin>(module, "SolvedSkin")
      .def("fields",
           [](const SolvedSkin& self) {
             return fields_of(self.answers(), self.grid(), self.width());
           })
      .def("notes", &SolvedSkin::notes)
      .def("json", &SolvedSkin::json, nb::arg("name"), nb::call_guard<nb::gil_scoped_release>())
      .def("html", &SolvedSkin::html, nb::arg("name"), nb::call_guard<nb::gil_scoped_release>())
      .def(
          "report",
          [](const SolvedSkin& self, const std::string& folder, bool force,
             const std::string& name) {
            return self.report({.path = folder, .force = force}, name);
          },
          nb::arg("folder"), nb::arg("force"), nb::arg("name"),
          nb::call_guard<nb::gil_scoped_release>());
  nb::class_<lab::SkinExperiment>(module, "SkinExperiment")
      .def_prop_ro("succeeded", &lab::SkinExperiment::succeeded)
      .def_prop_ro("refusal", [](const lab::SkinExperiment& self) { return self.refusal; })
      .def("truth", [](const lab::SkinExperiment& self) { return owned(self.frame.truth); })
      .def("readings", [](const lab::SkinExperiment& self) { return owned(self.frame.readings); })
      .def("relative",
           [](const lab::SkinExperiment& self) {
             return owned({self.relative.begin(), self.relative.end()});
           })
      .def("fields",
           [](const lab::SkinExperiment& self) {
             const std::size_t width = self.answer ? self.answer->tractions.size() : 0;
             return fields_of(self.answer ? Answers(&*self.answer, 1) : Answers(), self.grid,
                              width);
           })
      .def("remarks", &report::warnings)
      .def("text", &text)
      .def("json", [](const lab::SkinExperiment& self) { return report::experiment_json(self); })
      .def("html", [](const lab::SkinExperiment& self) { return pages::run_page(self, "").html; })
      .def("report", &report_of, nb::arg("folder"), nb::arg("force"));
  module.def("solve_skin", &solve, nb::arg("scene"), nb::arg("times"),
             nb::arg("readings").noconvert(), nb::arg("progress").none());
  module.def("run_skin", &run, nb::arg("scene"), nb::arg("frame").none(),
             nb::arg("progress").none());
  module.def("wrench_columns", &report::wrench_columns);
}

}  // namespace tactile_net::python
