#include "report/json/work_point_json.hpp"

#include "report/json/product_json.hpp"

namespace tactile_net {

template <>
struct Enumerators<study::Job::Kind> {
  using Task = study::Job::Kind;
  static constexpr Enumerator<Task> all[] = {
      {Task::products, "products", "Planned products with the reconstruction's matrix."},
      {Task::factorisations, "factorisations", "The closed form, and a QR of every frame."},
      {Task::fft, "fft", "Filters and iterations by FFT."},
      {Task::constraints, "constraints", "The active set."},
      {Task::fewer_taxels, "fewer_taxels", "Coarser arrays of the same aperture."},
      {Task::coarser_surface, "coarser_surface", "Fewer tractions from the same readings."},
      {Task::kronecker, "kronecker", "Of skins: sums of Kronecker products."},
      {Task::gradients, "gradients", "Of skins: conjugate gradients, by FFT and with the matrix."},
      {Task::array_sizes, "array_sizes", "Of skins: what a frame takes on arrays of other sizes."},
      {Task::forward_model, "forward_model", "Readings of known tractions."},
      {Task::settling, "settling", "The step response of the circuit of a realisation."},
      {Task::circuit_sizes, "circuit_sizes",
       "Of skins: how circuits of arrays of other sizes settle."},
      {Task::parts, "parts", "What inaccurate components do to each circuit."},
      {Task::moving, "moving", "How circuits and loops follow contacts that move."},
      {Task::operating_points, "operating_points", "What the simulator takes for one frame."}};
};

template <>
struct Enumerators<study::WorkCurve::Family> {
  using Family = study::WorkCurve::Family;
  static constexpr Enumerator<Family> all[] = {
      {Family::product, "product", "Planned products of a structure and a precision."},
      {Family::closed_form, "closed_form", "The explicit inverse, as a dense product."},
      {Family::factorisation, "factorisation", "A QR of every frame."},
      {Family::ring_filter, "ring_filter", "FFT, the array taken for a ring."},
      {Family::division, "division", "dft: division by the kernel's transform."},
      {Family::conjugate_gradients, "conjugate_gradients",
       "Conjugate gradients, with products by FFT."},
      {Family::active_set, "active_set",
       "Tractions under the scene's constraints, without any pull where it has none."},
      {Family::fewer_taxels, "fewer_taxels",
       "The same aperture, read at every second, third, ... taxel."},
      {Family::coarser_surface, "coarser_surface",
       "The same readings on grids of steps twice, four times, ... as long."},
      {Family::kronecker, "kronecker", "A sum of Kronecker products, rows and columns apart."},
      {Family::singular_values, "singular_values",
       "By the decomposition that every alpha shares, with another alpha for each frame."},
      {Family::matrix_gradients, "matrix_gradients",
       "Conjugate gradients, with products by the matrix itself."},
      {Family::friction_cone, "friction_cone", "A skin's constraints, by alternating directions."},
      {Family::planned_constraints, "planned_constraints",
       "A controller's frames, after so many steps towards the constraints."},
      {Family::coarse_cells, "coarse_cells", "Cells as wide as the taxels' pitch."},
      {Family::integral, "integral", "The forward model by the thesis' integrals."},
      {Family::discrete_sum, "discrete_sum", "The forward model by sums over the taxels."},
      {Family::circuit, "circuit",
       "The circuit of a realisation, of one bandwidth or node capacitance."},
      {Family::job, "job", "A task as a whole, which failed before it had a curve."}};
};

template <>
struct Enumerators<study::Knob::Kind> {
  using Setting = study::Knob::Kind;
  static constexpr Enumerator<Setting> all[] = {
      {Setting::none, "none", "The curve has one point."},
      {Setting::ranks, "ranks", "Ranks of the product's factors."},
      {Setting::steps, "steps", "A count of iterations."},
      {Setting::exchanges, "exchanges", "A count of exchanges of the active set."},
      {Setting::taxels, "taxels", "A count of taxels that are read."},
      {Setting::terms, "terms", "A count of Kronecker products, of all blocks together."},
      {Setting::array, "array", "Another array, of rows x columns taxels."},
      {Setting::surface_values, "surface_values", "A count of values of each traction."},
      {Setting::panel_points, "panel_points", "A count of points of the quadrature on each panel."},
      {Setting::halved_panels, "halved_panels",
       "Panels are halved until the integral is known to 1e-14."},
      {Setting::settled, "settled", "A circuit has come to within an error of its end."},
      {Setting::operating_point, "operating_point", "The circuit's end, without the way there."}};
};

namespace report {
namespace {

[[noreturn]] void fail() { throw std::runtime_error("it is not a study"); }

std::size_t count_of(const Json& json) {
  if (!json.is_number_unsigned()) fail();
  return json.get<std::size_t>();
}

/// Which kinds of settings are a count of something.
bool counts(study::Knob::Kind kind) {
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

/// A value that only settings of one kind have.
template <class T>
IfAny<T> only_if(bool has, const T& value) {
  return {has ? std::optional(value) : std::nullopt};
}

}  // namespace
}  // namespace report

template <>
struct Fields<study::Job> {
  static constexpr auto all = std::tuple{
      field("kind", &study::Job::kind, "Which of the study's tasks."),
      field(
          "realization", [](const study::Job& job) { return IfAny<Realization>{job.realization}; },
          "The circuit that settles; only of such a task.")};
};

template <>
struct Fields<study::WorkCurve> {
  using Curve = study::WorkCurve;
  static constexpr auto all = std::tuple{
      field("kind", &Curve::family, "Which method or circuit."),
      field(
          "structure", [](const Curve& one) { return IfAny<Structure>{one.structure}; },
          "How a product's matrix is stored; of products alone."),
      field(
          "precision", [](const Curve& one) { return IfAny<Precision>{one.precision}; },
          "The precision of its numbers; of products alone."),
      field(
          "realization", [](const Curve& one) { return IfAny<Realization>{one.realization}; },
          "How the network is built; of circuits alone."),
      field(
          "bandwidth", [](const Curve& one) { return IfAny<double>{one.bandwidth}; },
          Measure::frequency, "The op-amps' gain-bandwidth product; of circuits with op-amps."),
      field(
          "node_capacitance", [](const Curve& one) { return IfAny<double>{one.node_capacitance}; },
          Measure::capacitance, "The nodes' capacitance; of circuits without op-amps."),
      field(
          "tractions", [](const Curve& one) { return IfAny<std::size_t>{one.tractions}; },
          "Nodes of a circuit whose cells are wider than the study's own."),
      field(
          "task", [](const Curve& one) { return IfAny<study::Job>{one.job}; },
          "The task that failed as a whole.")};
};

template <>
struct Fields<study::Knob> {
  using Knob = study::Knob;
  static constexpr auto all = std::tuple{
      field("kind", &Knob::kind, "What differs from point to point."),
      field(
          "count",
          [](const Knob& one) { return report::only_if(report::counts(one.kind), one.count); },
          "How many; of settings that are a count."),
      field(
          "optimal",
          [](const Knob& one) { return report::only_if(report::counts(one.kind), one.optimal); },
          "Whether the iteration converged, or the exchanges reached the optimum; of settings that "
          "are a count."),
      field(
          "ranks",
          [](const Knob& one) {
            return report::only_if(one.kind == study::Knob::Kind::ranks, one.ranks);
          },
          "The ranks of the factors."),
      field(
          "rows",
          [](const Knob& one) {
            return report::only_if(one.kind == study::Knob::Kind::array, one.rows);
          },
          "Rows of the other array."),
      field(
          "columns",
          [](const Knob& one) {
            return report::only_if(one.kind == study::Knob::Kind::array, one.columns);
          },
          "Columns of the other array."),
      field(
          "error",
          [](const Knob& one) {
            return report::only_if(one.kind == study::Knob::Kind::settled,
                                   study::settling_levels[one.level]);
          },
          "The error to which a circuit has settled, relative."),
      field(
          "by_poles",
          [](const Knob& one) {
            return report::only_if(one.kind == study::Knob::Kind::settled, one.by_poles);
          },
          "Whether that is by the circuit's poles, where the simulator ran out of time."),
      field(
          "scaled",
          [](const Knob& one) {
            return report::only_if(one.kind == study::Knob::Kind::settled, one.scaled);
          },
          "Whether that is by the ratio of bandwidths, from 10 MHz.")};
};

namespace report {

Json JsonForm<study::Job>::json(const study::Job& job) { return fields_json(job); }
Json JsonForm<study::Job>::schema() { return object_schema<study::Job>(); }

Json JsonForm<study::WorkCurve>::json(const study::WorkCurve& curve) { return fields_json(curve); }
Json JsonForm<study::WorkCurve>::schema() {
  Json schema = object_schema<study::WorkCurve>();
  schema["if"] = {
      {"properties", {{"kind", {{"const", enumerator_name(study::WorkCurve::Family::product)}}}}}};
  schema["then"] = {{"required", {"structure", "precision"}}};
  return schema;
}

Json JsonForm<study::Knob>::json(const study::Knob& knob) { return fields_json(knob); }
Json JsonForm<study::Knob>::schema() { return object_schema<study::Knob>(); }

study::Job job_of(const Json& json) {
  study::Job job{.kind = one_named<study::Job::Kind>(json.at("kind"))};
  if (json.contains("realization"))
    job.realization = one_named<Realization>(json.at("realization"));
  if (job.realization.has_value() != (job.kind == study::Job::Kind::settling)) fail();
  return job;
}

study::WorkCurve curve_of(const Json& json) {
  study::WorkCurve curve{.family = one_named<study::WorkCurve::Family>(json.at("kind"))};
  if (curve.family == study::WorkCurve::Family::product) {
    curve.structure = one_named<Structure>(json.at("structure"));
    curve.precision = one_named<Precision>(json.at("precision"));
  } else if (curve.family == study::WorkCurve::Family::circuit) {
    curve.realization = one_named<Realization>(json.at("realization"));
    curve.bandwidth = optional_number(json, "bandwidth");
    curve.node_capacitance = optional_number(json, "node_capacitance");
    if (json.contains("tractions")) curve.tractions = count_of(json.at("tractions"));
  } else if (curve.family == study::WorkCurve::Family::job) {
    curve.job = job_of(json.at("task"));
  }
  return curve;
}

study::Knob knob_of(const Json& json) {
  study::Knob knob{.kind = one_named<study::Knob::Kind>(json.at("kind"))};
  if (counts(knob.kind)) {
    knob.count = count_of(json.at("count"));
    knob.optimal = json.at("optimal").get<bool>();
  }
  if (knob.kind == study::Knob::Kind::ranks)
    for (const Json& rank : json.at("ranks")) knob.ranks.push_back(count_of(rank));
  if (knob.kind == study::Knob::Kind::array) {
    knob.rows = count_of(json.at("rows"));
    knob.columns = count_of(json.at("columns"));
  }
  if (knob.kind == study::Knob::Kind::settled) {
    knob.level = settling_level(json.at("error").get<double>());
    knob.by_poles = json.at("by_poles").get<bool>();
    knob.scaled = json.at("scaled").get<bool>();
  }
  return knob;
}

}  // namespace report
}  // namespace tactile_net
