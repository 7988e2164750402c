// From a scene to the plan of a controller, and a plan as bytes.
#include "plan.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "arrays.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/report/words/controller_words.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

constexpr std::array structures = {Structure::dense, Structure::low_rank, Structure::reflections,
                                   Structure::reflections_low_rank, Structure::fft};
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

/// Of an even skin's taxels rows and columns; else 0.
std::pair<std::size_t, std::size_t> lattice_of(const Scene&) { return {}; }
std::pair<std::size_t, std::size_t> lattice_of(const SkinScene& scene) {
  if (!is_even(scene.sensor)) return {};
  return {scene.sensor.rows, scene.sensor.columns};
}

/// The same of a plan without its scene: one that uses the skin's symmetry has its lattice.
std::pair<std::size_t, std::size_t> lattice_of(const EstimatorPlan& plan) {
  if (!plan.cells || !has_reflections(plan.reconstruction.structure)) return {};
  const GridBlocks& taxels = plan.reconstruction.column_grid;
  return {taxels.rows, taxels.columns};
}

void refuse_fft(const Scene&, const PlannerOptions&) {}
void refuse_fft(const SkinScene&, const PlannerOptions& options) {
  if (options.allow_fft || options.structure == Structure::fft)
    throw std::invalid_argument("an fft is for line arrays, and this scene is of a skin");
}

template <class Any>
PlanPointer make_plan(Any& shared, double accuracy, const std::optional<Rows>& readings,
                      const std::optional<std::string>& structure,
                      const std::optional<std::string>& precision, bool diagnostics, bool allow_fft,
                      std::optional<double> friction, std::optional<double> friction_limit,
                      bool nonnegative, std::size_t steps, const nb::object& progress) {
  Watcher watcher(progress);
  PlannerOptions options;
  options.accuracy = accuracy;
  options.structure = named(structures, "structure", structure);
  options.precision = named(precisions, "precision", precision);
  options.diagnostics = diagnostics;
  options.allow_fft = allow_fft;
  options.friction_coefficient = friction;
  if (friction_limit || nonnegative) {
    options.cone.emplace().constraints.friction_limit = friction_limit;
    options.cone->steps = steps;
  } else if (steps > 0) {
    throw std::invalid_argument(
        "steps lead towards constraints: pass friction_limit= or nonnegative=True");
  }
  refuse_fft(shared.scene(), options);
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
  const auto [rows, columns] = lattice_of(shared.scene());
  return std::make_shared<const Plan>(
      Plan{.plan = planned.estimator.plan,
           .why = "alpha: " + report::in_words(planned.alpha) + "\n" + planned.estimator.why(),
           .for_raw_numbers = planned.for_raw_numbers,
           .needs_baseline = planned.needs_baseline,
           .rows = rows,
           .columns = columns});
}

nb::bytes bytes_of(const Plan& self) {
  const std::vector<std::byte> bytes = encode_plan(self.plan);
  return nb::bytes(bytes.data(), bytes.size());
}

/// @param rows, columns  of an even skin's taxels; 0: as the plan has them
PlanPointer plan_from(const nb::bytes& bytes, std::string why, bool for_raw_numbers,
                      bool needs_baseline, std::size_t rows, std::size_t columns) {
  const std::span text(bytes.c_str(), bytes.size());
  try {
    Plan plan{.plan = decode_plan(std::as_bytes(text)),
              .why = std::move(why),
              .for_raw_numbers = for_raw_numbers,
              .needs_baseline = needs_baseline,
              .rows = rows,
              .columns = columns};
    if (!plan.is_lattice()) std::tie(plan.rows, plan.columns) = lattice_of(plan.plan);
    const bool is_even_skin = plan.plan.cells && plan.plan.taxels.empty();
    if (plan.is_lattice() && (!is_even_skin || plan.rows * plan.columns != plan.plan.count))
      throw std::invalid_argument("the plan is not of " + std::to_string(plan.rows) + " x " +
                                  std::to_string(plan.columns) + " taxels of a skin");
    return std::make_shared<const Plan>(std::move(plan));
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

/// y of the tractions, of a skin of their rows [m].
Array places_y(const Plan& self) {
  const EstimatorPlan& plan = self.plan;
  const std::size_t count = plan.cells ? plan.cells->rows : plan.values;
  const double spacing = plan.cells ? plan.cells->spacing_y : plan.spacing;
  const double centre = plan.cells ? plan.cells->centre_y : plan.centre;
  std::vector<double> y(count);
  for (std::size_t i = 0; i < count; ++i) y[i] = centre + centred(i, count) * spacing;
  return owned(std::move(y));
}

/// z of a skin's columns [m]; of a line none.
Array places_z(const Plan& self) {
  const auto& cells = self.plan.cells;
  std::vector<double> z(cells ? cells->columns : 0);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = cells->centre_z + centred(i, z.size()) * cells->spacing_z;
  return owned(std::move(z));
}

std::pair<double, double> spacings(const Plan& self) {
  const auto& cells = self.plan.cells;
  return cells ? std::pair(cells->spacing_y, cells->spacing_z)
               : std::pair(self.plan.spacing, self.plan.spacing);
}

template <class Any>
void bind_make_plan(nb::module_& module) {
  module.def("plan", &make_plan<Any>, nb::arg("scene"), nb::arg("accuracy"),
             nb::arg("readings").noconvert().none(), nb::arg("structure").none(),
             nb::arg("precision").none(), nb::arg("diagnostics"), nb::arg("allow_fft"),
             nb::arg("friction").none(), nb::arg("friction_limit").none(), nb::arg("nonnegative"),
             nb::arg("steps"), nb::arg("progress").none());
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
      .def_prop_ro("is_skin", [](const Plan& self) { return self.plan.cells.has_value(); })
      .def_ro("rows", &Plan::rows)
      .def_ro("columns", &Plan::columns)
      .def_prop_ro("spacings", &spacings)
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
      .def_prop_ro("friction_limit",
                   [](const Plan& self) {
                     return self.plan.cone ? self.plan.cone->friction_limit : std::nullopt;
                   })
      .def_prop_ro("steps",
                   [](const Plan& self) { return self.plan.cone ? self.plan.cone->steps : 0; })
      .def_prop_ro("unfinished",
                   [](const Plan& self) {
                     const ExpectedUnfinished of =
                         self.plan.cone ? self.plan.cone->expected : ExpectedUnfinished{};
                     return std::tuple(of.median, of.high, of.worst);
                   })
      .def_ro("why", &Plan::why)
      .def_ro("for_raw_numbers", &Plan::for_raw_numbers)
      .def_ro("needs_baseline", &Plan::needs_baseline)
      .def("y", &places_y)
      .def("z", &places_z)
      .def("to_bytes", &bytes_of);
  bind_make_plan<SharedScene>(module);
  bind_make_plan<SharedSkin>(module);
  module.def("plan_from", &plan_from, nb::arg("bytes"), nb::arg("why"), nb::arg("for_raw_numbers"),
             nb::arg("needs_baseline"), nb::arg("rows"), nb::arg("columns"));
}

}  // namespace tactile_net::python
