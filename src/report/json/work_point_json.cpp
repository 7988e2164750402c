#include "report/json/work_point_json.hpp"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "numeric/named.hpp"

namespace tactile_net::report {
namespace {

using Task = study::Job::Kind;
using Family = study::WorkCurve::Family;
using Setting = study::Knob::Kind;

constexpr Named<Task> task_names[] = {
    {Task::products, "products"},
    {Task::factorisations, "factorisations"},
    {Task::fft, "fft"},
    {Task::constraints, "constraints"},
    {Task::fewer_taxels, "fewer_taxels"},
    {Task::coarser_surface, "coarser_surface"},
    {Task::kronecker, "kronecker"},
    {Task::gradients, "gradients"},
    {Task::array_sizes, "array_sizes"},
    {Task::forward_model, "forward_model"},
    {Task::settling, "settling"},
    {Task::circuit_sizes, "circuit_sizes"},
    {Task::parts, "parts"},
    {Task::moving, "moving"},
    {Task::operating_points, "operating_points"},
};

constexpr Named<Family> family_names[] = {
    {Family::product, "product"},
    {Family::closed_form, "closed_form"},
    {Family::factorisation, "factorisation"},
    {Family::ring_filter, "ring_filter"},
    {Family::division, "division"},
    {Family::conjugate_gradients, "conjugate_gradients"},
    {Family::active_set, "active_set"},
    {Family::fewer_taxels, "fewer_taxels"},
    {Family::coarser_surface, "coarser_surface"},
    {Family::kronecker, "kronecker"},
    {Family::singular_values, "singular_values"},
    {Family::matrix_gradients, "matrix_gradients"},
    {Family::friction_cone, "friction_cone"},
    {Family::coarse_cells, "coarse_cells"},
    {Family::integral, "integral"},
    {Family::discrete_sum, "discrete_sum"},
    {Family::circuit, "circuit"},
    {Family::job, "job"},
};

constexpr Named<Setting> setting_names[] = {
    {Setting::none, "none"},
    {Setting::ranks, "ranks"},
    {Setting::steps, "steps"},
    {Setting::exchanges, "exchanges"},
    {Setting::taxels, "taxels"},
    {Setting::terms, "terms"},
    {Setting::array, "array"},
    {Setting::surface_values, "surface_values"},
    {Setting::panel_points, "panel_points"},
    {Setting::halved_panels, "halved_panels"},
    {Setting::settled, "settled"},
    {Setting::operating_point, "operating_point"},
};

constexpr std::array structures = {Structure::dense, Structure::low_rank, Structure::fft,
                                   Structure::reflections, Structure::reflections_low_rank};
constexpr std::array precisions = {Precision::float64, Precision::float32};

[[noreturn]] void fail() { throw std::runtime_error("it is not a study"); }

/// The enumerator that `json` names as its kind.
template <const auto& table>
auto kind_named(const Json& json) {
  const auto kind = named_in<table>(json.at("kind").template get<std::string>());
  if (!kind) fail();
  return *kind;
}

std::size_t count_of(const Json& json) {
  if (!json.is_number_unsigned()) fail();
  return json.get<std::size_t>();
}

/// Which kinds of settings are a count of something.
bool counts(Setting kind) {
  using enum study::Knob::Kind;
  return kind == steps || kind == exchanges || kind == taxels || kind == terms ||
         kind == surface_values || kind == panel_points;
}

std::optional<double> optional_number(const Json& json, const char* key) {
  return json.contains(key) ? std::optional(json.at(key).get<double>()) : std::nullopt;
}

std::size_t settling_level(double error) {
  for (std::size_t level = 0; level < study::settling_levels.size(); ++level)
    if (study::settling_levels[level] == error) return level;
  fail();
}

}  // namespace

Json task_json(const study::Job& job) {
  Json json = {{"kind", name_in<task_names>(job.kind)}};
  if (job.realization) json["realization"] = name(*job.realization);
  return json;
}

Json method_json(const study::WorkCurve& curve) {
  Json json = {{"kind", name_in<family_names>(curve.family)}};
  if (curve.structure) json["structure"] = name(*curve.structure);
  if (curve.precision) json["precision"] = name(*curve.precision);
  if (curve.realization) json["realization"] = name(*curve.realization);
  if (curve.bandwidth) json["bandwidth"] = *curve.bandwidth;
  if (curve.node_capacitance) json["node_capacitance"] = *curve.node_capacitance;
  if (curve.tractions) json["tractions"] = *curve.tractions;
  if (curve.job) json["task"] = task_json(*curve.job);
  return json;
}

Json setting_json(const study::Knob& knob) {
  Json json = {{"kind", name_in<setting_names>(knob.kind)}};
  if (counts(knob.kind)) json.update(Json{{"count", knob.count}, {"optimal", knob.optimal}});
  if (knob.kind == Setting::ranks) json["ranks"] = knob.ranks;
  if (knob.kind == Setting::array)
    json.update(Json{{"rows", knob.rows}, {"columns", knob.columns}});
  if (knob.kind == Setting::settled)
    json.update(Json{{"error", study::settling_levels[knob.level]},
                     {"by_poles", knob.by_poles},
                     {"scaled", knob.scaled}});
  return json;
}

study::Job job_of(const Json& json) {
  study::Job job{.kind = kind_named<task_names>(json)};
  if (json.contains("realization"))
    job.realization = one_named(realizations, json.at("realization"));
  if (job.realization.has_value() != (job.kind == Task::settling)) fail();
  return job;
}

study::WorkCurve curve_of(const Json& json) {
  study::WorkCurve curve{.family = kind_named<family_names>(json)};
  if (curve.family == Family::product) {
    curve.structure = one_named(structures, json.at("structure"));
    curve.precision = one_named(precisions, json.at("precision"));
  } else if (curve.family == Family::circuit) {
    curve.realization = one_named(realizations, json.at("realization"));
    curve.bandwidth = optional_number(json, "bandwidth");
    curve.node_capacitance = optional_number(json, "node_capacitance");
    if (json.contains("tractions")) curve.tractions = count_of(json.at("tractions"));
  } else if (curve.family == Family::job) {
    curve.job = job_of(json.at("task"));
  }
  return curve;
}

study::Knob knob_of(const Json& json) {
  study::Knob knob{.kind = kind_named<setting_names>(json)};
  if (counts(knob.kind)) {
    knob.count = count_of(json.at("count"));
    knob.optimal = json.at("optimal").get<bool>();
  }
  if (knob.kind == Setting::ranks)
    for (const Json& rank : json.at("ranks")) knob.ranks.push_back(count_of(rank));
  if (knob.kind == Setting::array) {
    knob.rows = count_of(json.at("rows"));
    knob.columns = count_of(json.at("columns"));
  }
  if (knob.kind == Setting::settled) {
    knob.level = settling_level(json.at("error").get<double>());
    knob.by_poles = json.at("by_poles").get<bool>();
    knob.scaled = json.at("scaled").get<bool>();
  }
  return knob;
}

}  // namespace tactile_net::report
