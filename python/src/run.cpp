// A scene of a line or a skin put through all that it names.
#include "tactile_net/lab/run.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <sstream>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/pages/run_page.hpp"
#include "tactile_net/report/json/contacts_json.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

using MethodAnswer = nb::typed<nb::dict, nb::str, nb::any>;

/// A component a row, of a skin (components, rows, columns); None: there are no values.
std::optional<Array> stacked(const lab::Experiment& self, const std::vector<double>& values,
                             const std::optional<SurfaceGrid>& other_grid = {}) {
  if (values.empty()) return std::nullopt;
  if (!self.of_skin()) return owned(values, {values.size() / self.places(), self.places()});
  const SurfaceGrid& grid = other_grid ? *other_grid : self.grid;
  return owned(values, {values.size() / grid.count(), grid.rows, grid.columns});
}

/// A value and its deviation; None: not known.
nb::object pair_of(const std::optional<Uncertain>& number) {
  return number ? nb::cast(nb::make_tuple(number->value, number->deviation)) : nb::none();
}

/// By the names of Python's MethodResult.
MethodAnswer answer(const lab::Experiment& experiment, const lab::MethodResult& result) {
  const lab::FrameAnswer& told = result.answer;
  MethodAnswer found;
  found["method"] = name(result.method);
  found["verdict"] = lab::name(told.verdict);
  found["tractions"] = stacked(experiment, told.tractions, result.grid);
  found["deviation"] = stacked(experiment, told.deviations, result.grid);
  found["alpha"] = told.alpha.known() ? nb::cast(told.alpha.value) : nb::none();
  found["alpha_source"] = told.alpha.known() ? nb::cast(lab::source(told.alpha)) : nb::none();
  found["relative_error"] = result.errors.empty() ? unknown : result.errors.front().relative;
  found["error_bound"] = told.error_bound ? nb::cast(*told.error_bound) : nb::none();
  found["remarks"] = report::remarks_in_words(experiment, result).all();
  found["failure"] = report::failure_in_words(experiment, result);
  return found;
}

/// What is a line's own.
void add_line(MethodAnswer& found, const lab::MethodResult& result) {
  const auto& data = result.answer.data;
  found["force"] = result.force;
  found["data"] = data ? nb::cast(report::data_word(*data)) : nb::none();
  const UncertainResultant* resultant = result.resultant();
  found["normal_force"] = resultant ? pair_of(resultant->normal) : nb::none();
  found["tangential_force"] = resultant ? pair_of(resultant->tangential) : nb::none();
  found["centre"] = resultant ? pair_of(resultant->centre) : nb::none();
  found["patches"] = report::contacts_json(
      resultant ? result.answer.bands->patches : std::vector<ContactPatch>(), false);
}

/// What is a skin's own, by the names of SkinMethodResult.
void add_skin(MethodAnswer& found, const lab::Experiment& experiment,
              const lab::MethodResult& result) {
  const lab::FrameAnswer& told = result.answer;
  const UncertainWrench& wrench = told.wrench;
  const auto known = [&](const std::optional<Uncertain>& number) {
    return told.has_bands() ? pair_of(number) : nb::none();
  };
  found["force"] = !result.has_answer() ? unknown
                   : told.has_bands()   ? wrench.normal.value
                                        : result.force;
  found["data"] =
      told.data ? nb::cast(report::data_word(*told.data, experiment.skin())) : nb::none();
  found["normal_force"] = known(wrench.normal);
  found["tangential_force"] = nb::none();
  found["centre"] = nb::none();
  found["tangential_y_force"] = known(wrench.tangential_y);
  found["tangential_z_force"] = known(wrench.tangential_z);
  found["centre_y"] = known(wrench.centre_y);
  found["centre_z"] = known(wrench.centre_z);
  found["torsion"] = known(wrench.torsion);
  found["friction"] = known(told.friction ? std::optional(told.friction->ratio) : std::nullopt);
  found["patches"] = report::contacts_json(told.patches, true);
  std::vector<double> relative(3, unknown);
  for (std::size_t c = 0; c < result.errors.size(); ++c) relative[c] = result.errors[c].relative;
  found["relative_errors"] = nb::tuple(nb::cast(relative));
  std::vector<double> touching(experiment.grid.count());
  for (const std::size_t cell : told.cells) touching[cell] = 1.0;
  found["touching"] = owned(std::move(touching), {experiment.grid.rows, experiment.grid.columns});
  found["contacts"] = told.patches.size();
}

std::vector<MethodAnswer> answers(const lab::Experiment& self) {
  std::vector<MethodAnswer> all;
  for (const lab::MethodResult& result : self.results) {
    all.push_back(answer(self, result));
    if (self.of_skin())
      add_skin(all.back(), self, result);
    else
      add_line(all.back(), result);
  }
  return all;
}

std::string text(const lab::Experiment& self) {
  std::ostringstream out;
  report::print_experiment(out, self);
  return out.str();
}

void write_report(const lab::Experiment& self, const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  write_page({.path = folder, .force = force}, pages::run_page(self, ""), "result.json",
             report::experiment_json(self));
}

lab::Experiment run(const SharedScene& shared, std::optional<std::size_t> frame, bool compare_rules,
                    bool report, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  const std::unique_ptr<Simulator> simulator = lab::make_simulator();
  return lab::run(frame ? at_frame(shared.scene(), *frame) : shared.scene(), *simulator,
                  {.compare_rules = compare_rules, .report = report}, watcher);
}

lab::Experiment run_skin(const SharedSkin& shared, std::optional<std::size_t> frame,
                         bool with_circuit, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  lab::Experiment experiment =
      lab::run(frame ? at_frame(shared.scene(), *frame) : shared.scene(), {}, watcher);
  if (with_circuit) lab::run_circuit(experiment, *lab::make_simulator(), watcher);
  return experiment;
}

}  // namespace

void bind_run(nb::module_& module) {
  nb::class_<lab::Experiment>(module, "Experiment")
      .def_prop_ro("succeeded", &lab::Experiment::succeeded)
      .def_prop_ro("force", [](const lab::Experiment& self) { return self.frame.force; })
      .def("truth", [](const lab::Experiment& self) { return stacked(self, self.frame.truth); })
      .def("readings", [](const lab::Experiment& self) { return owned(self.frame.readings); })
      .def("notes", [](const lab::Experiment& self) { return report::in_words(self.frame); })
      .def("answers", &answers)
      .def("cells", [](const lab::Experiment& self) { return report::comparison_cells(self); })
      .def("text", &text)
      .def("json", [](const lab::Experiment& self) { return report::experiment_json(self); })
      .def("html", [](const lab::Experiment& self) { return pages::run_page(self, "").html; })
      .def("report", &write_report, nb::arg("folder"), nb::arg("force"));
  module.def("run", &run, nb::arg("scene"), nb::arg("frame").none(), nb::arg("compare_rules"),
             nb::arg("report"), nb::arg("progress").none());
  module.def("run_skin", &run_skin, nb::arg("scene"), nb::arg("frame").none(),
             nb::arg("with_circuit"), nb::arg("progress").none());
}

}  // namespace tactile_net::python
