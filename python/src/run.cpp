// A scene put through all that it names.
#include "tactile_net/lab/run.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bound_experiment.hpp"
#include "contact_rows.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

using MethodAnswer = nb::typed<nb::dict, nb::str, nb::any>;

/// Normal, then tangential where there is any: a row each.
std::optional<Array> stacked(const std::vector<double>& normal,
                             const std::vector<double>& tangential) {
  if (normal.empty()) return std::nullopt;
  std::vector<double> both = normal;
  both.insert(both.end(), tangential.begin(), tangential.end());
  return owned(std::move(both), {tangential.empty() ? 1U : 2U, normal.size()});
}

/// One method's answer by the names of Python's MethodResult.
MethodAnswer answer(const lab::Experiment& experiment, const lab::MethodResult& result) {
  MethodAnswer found;
  found["method"] = name(result.method);
  found["verdict"] = lab::name(result.verdict);
  found["tractions"] = stacked(result.normal.traction, result.tangential.traction);
  found["deviation"] = stacked(result.normal.deviation, result.tangential.deviation);
  found["alpha"] = result.alpha ? nb::cast(result.alpha->value) : nb::none();
  found["alpha_source"] = result.alpha ? nb::cast(lab::source(*result.alpha)) : nb::none();
  found["force"] = result.force;
  found["relative_error"] = result.normal.relative_l2;
  found["error_bound"] = result.error_bound ? nb::cast(*result.error_bound) : nb::none();
  found["data"] = result.data ? nb::cast(report::data_word(*result.data)) : nb::none();
  const auto& resultant = result.resultant;
  found["normal_force"] = resultant ? pair_of(resultant->normal) : nb::none();
  found["tangential_force"] = resultant ? pair_of(resultant->tangential) : nb::none();
  found["centre"] = resultant ? pair_of(resultant->centre) : nb::none();
  found["patches"] = contact_rows(result.patches);
  found["remarks"] = report::remarks_in_words(experiment, result).all();
  found["failure"] = report::failure_in_words(experiment, result);
  return found;
}

std::vector<MethodAnswer> answers(const lab::Experiment& self) {
  std::vector<MethodAnswer> all;
  for (const lab::MethodResult& result : self.results) all.push_back(answer(self, result));
  return all;
}

lab::Experiment run(const SharedScene& shared, std::optional<std::size_t> frame, bool compare_rules,
                    bool report, const nb::object& progress) {
  Watcher watcher(progress);
  const nb::gil_scoped_release released;
  const std::unique_ptr<Simulator> simulator = lab::make_simulator();
  return lab::run(frame ? at_frame(shared.scene(), *frame) : shared.scene(), *simulator,
                  {.compare_rules = compare_rules, .report = report}, watcher);
}

}  // namespace

void bind_run(nb::module_& module) {
  nb::class_<lab::Experiment> experiment(module, "Experiment");
  bind_what_experiments_share(experiment);
  experiment
      .def("truth",
           [](const lab::Experiment& self) {
             return stacked(self.frame.truth.normal, self.frame.truth.tangential);
           })
      .def_prop_ro("force", [](const lab::Experiment& self) { return self.frame.force; })
      .def("notes", [](const lab::Experiment& self) { return report::in_words(self.frame); })
      .def("answers", &answers)
      .def("cells", [](const lab::Experiment& self) { return report::comparison_cells(self); });
  module.def("run", &run, nb::arg("scene"), nb::arg("frame").none(), nb::arg("compare_rules"),
             nb::arg("report"), nb::arg("progress").none());
}

}  // namespace tactile_net::python
