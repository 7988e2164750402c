// From a scene to the plan of a controller, and a plan as bytes.
#include "plan.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "arrays.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/report/words/controller_words.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

using PlanPointer = std::shared_ptr<const Plan>;

constexpr std::array structures = {Structure::dense, Structure::low_rank, Structure::parity,
                                   Structure::parity_low_rank, Structure::fft};
constexpr std::array precisions = {Precision::float64, Precision::float32};

/// That of this name among all. @param what  they are
template <class Kinds>
std::optional<typename Kinds::value_type> named(const Kinds& kinds, const char* what,
                                                const std::optional<std::string>& wanted) {
  if (!wanted) return std::nullopt;
  std::string known;
  for (const auto kind : kinds) {
    if (name(kind) == *wanted) return kind;
    known += (known.empty() ? "" : ", ") + std::string(name(kind));
  }
  throw std::invalid_argument("there is no " + std::string(what) + " '" + *wanted + "': " + known);
}

PlanPointer make_plan(SharedScene& shared, double accuracy, const std::optional<Rows>& readings,
                      const std::optional<std::string>& structure,
                      const std::optional<std::string>& precision, bool diagnostics, bool allow_fft,
                      std::optional<double> friction, const nb::object& progress) {
  Watcher watcher(progress);
  PlannerOptions options;
  options.accuracy = accuracy;
  options.structure = named(structures, "structure", structure);
  options.precision = named(precisions, "precision", precision);
  options.diagnostics = diagnostics;
  options.allow_fft = allow_fft;
  options.friction_coefficient = friction;
  lab::NextFrame next;
  std::size_t frame = 0;
  if (readings)
    next = [&](std::span<double> values) {
      if (frame == readings->shape(0)) return false;
      const auto values_of_frame = row(*readings, frame++);
      std::copy(values_of_frame.begin(), values_of_frame.end(), values.begin());
      return true;
    };
  const nb::gil_scoped_release released;
  const auto locked = shared.lock();
  const auto alpha = lab::plan_alpha(locked.problem, next, watcher);
  if (!alpha)
    throw std::invalid_argument(
        "a plan has one alpha for all frames, and this scene has a rule for it, but neither a "
        "contact nor readings to apply it to: pass readings=, or set reconstruct.alpha");
  const lab::PlannedController planned = lab::plan_controller(locked.problem, *alpha, options);
  return std::make_shared<const Plan>(
      Plan{.plan = planned.estimator.plan,
           .why = "alpha: " + report::in_words(planned.alpha) + "\n" + planned.estimator.why(),
           .for_raw_numbers = planned.for_raw_numbers,
           .needs_baseline = planned.needs_baseline});
}

nb::bytes bytes_of(const Plan& self) {
  const std::vector<std::byte> bytes = encode_plan(self.plan);
  return nb::bytes(bytes.data(), bytes.size());
}

PlanPointer plan_from(const nb::bytes& bytes, std::string why, bool for_raw_numbers,
                      bool needs_baseline) {
  const std::span text(bytes.c_str(), bytes.size());
  try {
    return std::make_shared<const Plan>(Plan{.plan = decode_plan(std::as_bytes(text)),
                                             .why = std::move(why),
                                             .for_raw_numbers = for_raw_numbers,
                                             .needs_baseline = needs_baseline});
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

/// y of the tractions [m].
Array places(const Plan& self) {
  const EstimatorPlan& plan = self.plan;
  std::vector<double> y(plan.values);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = plan.centre + centred(i, plan.values) * plan.spacing;
  return owned(std::move(y));
}

}  // namespace

void bind_plan(nb::module_& module) {
  nb::class_<Plan>(module, "Plan")
      .def_prop_ro("label", [](const Plan& self) { return self.plan.label; })
      .def_prop_ro("channels", [](const Plan& self) { return self.plan.channels; })
      .def_prop_ro("count", [](const Plan& self) { return self.plan.count; })
      .def_prop_ro("even", [](const Plan& self) { return self.plan.taxels.empty(); })
      .def_prop_ro("readings", [](const Plan& self) { return self.plan.readings(); })
      .def_prop_ro("unknowns", [](const Plan& self) { return self.plan.unknowns; })
      .def_prop_ro("values", [](const Plan& self) { return self.plan.values; })
      .def_prop_ro("spacing", [](const Plan& self) { return self.plan.spacing; })
      .def_prop_ro("alpha", [](const Plan& self) { return self.plan.alpha; })
      .def_prop_ro("accuracy", [](const Plan& self) { return self.plan.accuracy; })
      .def_prop_ro("error_bound", [](const Plan& self) { return self.plan.error_bound; })
      .def_prop_ro("structure",
                   [](const Plan& self) { return name(self.plan.reconstruction.structure); })
      .def_prop_ro("precision",
                   [](const Plan& self) { return name(self.plan.reconstruction.precision); })
      .def_prop_ro("streamed_bytes",
                   [](const Plan& self) {
                     return streamed_bytes(self.plan.reconstruction) +
                            (self.plan.prediction ? streamed_bytes(*self.plan.prediction) : 0);
                   })
      .def_prop_ro("diagnostics", [](const Plan& self) { return self.plan.prediction.has_value(); })
      .def_ro("why", &Plan::why)
      .def_ro("for_raw_numbers", &Plan::for_raw_numbers)
      .def_ro("needs_baseline", &Plan::needs_baseline)
      .def("y", &places)
      .def("to_bytes", &bytes_of);
  module.def("plan", &make_plan, nb::arg("scene"), nb::arg("accuracy"),
             nb::arg("readings").noconvert().none(), nb::arg("structure").none(),
             nb::arg("precision").none(), nb::arg("diagnostics"), nb::arg("allow_fft"),
             nb::arg("friction").none(), nb::arg("progress").none());
  module.def("plan_from", &plan_from, nb::arg("bytes"), nb::arg("why"), nb::arg("for_raw_numbers"),
             nb::arg("needs_baseline"));
}

}  // namespace tactile_net::python
