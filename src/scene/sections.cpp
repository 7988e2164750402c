#include "scene/sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "scene/calibration_section.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

namespace {

constexpr Rule at_least_one{"must be >= 1", [](double x) noexcept { return x >= 1.0; }};

// --- [reconstruct] ------------------------------------------------------------------------------

/// Where each method that was understood stands in the file.
struct NamedMethod {
  Method method;
  Value value;
};

std::vector<NamedMethod> read_methods(const Value& value) {
  constexpr std::array methods = {Method::dft, Method::tikhonov, Method::closed_form,
                                  Method::network};
  const auto names = names_of(methods);
  std::vector<NamedMethod> result;
  const auto list = value.list("methods, such as \"tikhonov\"");
  if (!list) return result;
  if (list->empty())
    value.problem("must name at least one method",
                  "one of " + listed({names.begin(), names.end()}));
  for (const Value& item : *list) {
    const auto index = item.one_of("method", names);
    if (!index) continue;
    const Method method = methods[*index];
    if (std::any_of(result.begin(), result.end(),
                    [=](const NamedMethod& named) { return named.method == method; }))
      item.problem("names " + in_quotes(name(method)) + " twice", "remove one");
    else
      result.push_back({method, item});
  }
  return result;
}

bool is_noisy(const Scene& scene) {
  return scene.noise && std::any_of(scene.noise->rms.begin(), scene.noise->rms.end(),
                                    [](const auto& rms) { return rms.second > 0.0; });
}

/// What the methods ask of the array and the noise.
void check_methods(const std::vector<NamedMethod>& methods, const Scene& scene, const Read& read) {
  if (!read.reads_complete || methods.empty()) return;
  for (const NamedMethod& named : methods)
    if (named.method == Method::dft && !is_even(scene.sensor))
      named.value.problem("is for " + std::string(equal_taxels), "\"tikhonov\"");
  const auto& reads = scene.sensor.reads;
  const bool strains = std::any_of(reads.begin(), reads.end(), is_strain);
  const bool stresses = !std::all_of(reads.begin(), reads.end(), is_strain);
  const bool weighted = scene.noise && scene.noise->weights_rows;
  if (strains && stresses && !weighted)
    read.reads->problem(
        "mixes strains and stresses, whose errors can only be added if noise.rms "
        "says how large each is",
        "under [noise], rms = { strain_x = 1e-4, stress_x = 20.0 }: one for each "
        "quantity");
}

void read_constraints(Table& table, const Scene& scene, const Read& read,
                      const std::vector<NamedMethod>& methods, ReconstructOptions& options) {
  const bool known = read.reads_complete && read.depths_complete;
  const bool one_channel = channel_count(scene.sensor) == 1;
  const auto uses = [&](Method method) {
    return methods.empty() ? method == Method::tikhonov
                           : std::any_of(methods.begin(), methods.end(),
                                         [=](const NamedMethod& n) { return n.method == method; });
  };
  constexpr std::string_view two_quantities =
      "read a second quantity, such as reads = [\"stress_x\", \"shear_xy\"], or one at two depths";

  if (const auto nonnegative = table.value("nonnegative"))
    options.nonnegative = nonnegative->boolean().value_or(false);
  if (const auto limit = table.value("friction_limit")) {
    options.friction_limit = limit->number(positive);
    if (known && one_channel)
      limit->problem("bounds the tangential traction, which one quantity at one depth cannot tell",
                     std::string{two_quantities});
  }
  if (const auto weight = table.value("tangential_weight"))
    if (read_tangential_weight(*weight, options.tangential_weight) && known && one_channel)
      weight->problem("weighs the tangential traction, which one quantity at one depth cannot tell",
                      std::string{two_quantities});
  if (const auto active = table.value("alpha_on_active_set")) {
    options.alpha_on_active_set = active->boolean().value_or(false);
    if (options.alpha_on_active_set && !options.nonnegative && !options.friction_limit)
      active->problem("chooses alpha under constraints, and this scene has none",
                      "friction_limit = 0.8, or nonnegative = true");
    if (options.alpha_on_active_set && options.alpha)
      active->problem("chooses alpha, and this scene gives one", "alpha = \"evidence\"");
  }
  if (const auto tangential = table.value("tangential")) {
    options.tangential = tangential->boolean();
    if (options.tangential == true && known && one_channel)
      tangential->problem("asks for a traction that one quantity at one depth cannot tell",
                          std::string{two_quantities});
    if (options.tangential == false && options.friction_limit)
      tangential->problem("leaves out the traction that friction_limit bounds", "remove one");
  }
  if (const auto friction = table.value("contact_friction")) {
    options.contact_friction = friction->number(any_number);
    if (!uses(Method::dft))
      friction->problem("is used by the method \"dft\" alone, which this scene does not name",
                        "remove it, or add \"dft\" to methods");
    else if (known && !one_channel)
      friction->problem("is for one quantity at one depth; this array can tell the friction itself",
                        "remove it");
  }
}

/// By default tractions lie at the taxels where these are dense, and for what knows no other place.
SurfaceBasis default_basis(const Scene& scene, bool uses_dft) {
  if (!is_even(scene.sensor)) return SurfaceBasis::hats;
  const bool dense = scene.sensor.depths.empty() || is_dense(scene.sensor);
  return dense || uses_dft || scene.forward == ForwardModel::sampled ? SurfaceBasis::taxels
                                                                     : SurfaceBasis::hats;
}

/// How many there are. @throw std::invalid_argument  as `surface`
std::size_t tractions(Scene scene, const ReconstructOptions& options) {
  scene.reconstruct = options;
  return unknowns(scene) * surface(scene).count;
}

void read_surface(Table& table, const Scene& scene, const Read& read, bool uses_dft,
                  ReconstructOptions& options) {
  constexpr std::array bases = {SurfaceBasis::taxels, SurfaceBasis::hats};
  options.surface.basis = default_basis(scene, uses_dft);
  if (const auto basis = table.value("surface"))
    if (const auto index = basis->one_of("surface", names_of(bases))) {
      options.surface.basis = bases[*index];
      if (uses_dft && options.surface.basis == SurfaceBasis::hats)
        basis->problem(
            "gives tractions where there are no readings, and dft divides one by the other",
            "surface = \"taxels\", or methods without \"dft\"");
      if (options.surface.basis == SurfaceBasis::taxels && !is_even(scene.sensor))
        basis->problem("puts tractions over " + std::string(equal_taxels), "surface = \"grid\"");
    }
  const auto spacing = table.value("spacing");
  const auto margin = table.value("margin");
  for (const auto* length : {&spacing, &margin})
    if (*length && options.surface.basis == SurfaceBasis::taxels)
      (*length)->problem("applies to a grid, but the tractions lie at the taxels",
                         "surface = \"grid\", or remove it");
  if (spacing) options.surface.spacing = spacing->number(positive, read.units.length);
  if (margin) options.surface.margin = margin->number(not_negative, read.units.length);
  const SensorArray& array = scene.sensor;
  if ((!spacing && !margin) || array.count < 2 || !(array.pitch > 0.0) || array.depths.empty() ||
      !read.reads_complete)
    return;
  const Value& named = spacing ? *spacing : *margin;
  try {
    const std::size_t columns = tractions(scene, options);
    if (columns > most_columns)
      named.problem("makes " + std::to_string(columns) + " unknown tractions, more than " +
                        std::to_string(most_columns),
                    "a quarter of the depth resolves all that the pad lets through");
  } catch (const std::invalid_argument& error) {
    named.problem("makes no surface: " + std::string(error.what()),
                  "spacing = a quarter of the depth");
  }
}

/// After the surface and the methods are known.
void read_offset(const Value& offset, const Scene& scene, const Read& read, bool uses_dft,
                 ReconstructOptions& options) {
  options.offset = offset.boolean().value_or(false);
  if (!options.offset) return;
  if (uses_dft)
    offset.problem("leaves the mean of the readings open, by which dft finds that of the tractions",
                   "methods without \"dft\"");
  const SensorArray& array = scene.sensor;
  if (array.count < 2 || !(array.pitch > 0.0) || array.depths.empty() || !read.reads_complete)
    return;
  if (!is_measured(array, {.dead_taxels = scene.dead_taxels, .unknown_offsets = true}))
    offset.problem("takes one reading a channel, and no channel has two living taxels",
                   "remove it");
  try {
    if (const std::size_t columns = tractions(scene, options); columns > most_columns)
      offset.problem("takes a decomposition of " + std::to_string(columns) +
                         " unknown tractions, more than " + std::to_string(most_columns),
                     "remove it: unloaded frames say the offsets, too ([calibration])");
  } catch (const std::invalid_argument&) {  // no surface: said of its spacing
  }
}

ReconstructOptions read_reconstruct(Table table, const Scene& scene, const Read& read) {
  ReconstructOptions options;
  std::vector<NamedMethod> methods;
  if (const auto value = table.value("methods")) {
    methods = read_methods(*value);
    options.methods.clear();
    for (const NamedMethod& named : methods) options.methods.push_back(named.method);
  }
  const bool uses_dft = std::find(options.methods.begin(), options.methods.end(), Method::dft) !=
                        options.methods.end();
  if (const auto alpha = table.value("alpha"))
    read_alpha(*alpha, alpha_unit(read.units, scene), is_noisy(scene), options.alpha,
               options.alpha_rule);
  if (const auto length = table.value("smoothing_length"))
    options.smoothing_length = length->number(not_negative, read.units.length).value_or(0.0);
  else
    options.smoothing_length = scene.reconstruct.smoothing_length;
  if (const auto limit = table.value("noise_gain_limit"))
    options.noise_gain_limit = limit->number(at_least_one).value_or(options.noise_gain_limit);
  read_constraints(table, scene, read, methods, options);
  read_surface(table, scene, read, uses_dft, options);
  if (const auto offset = table.value("offset"))
    read_offset(*offset, scene, read, uses_dft, options);
  check_methods(methods, scene, read);
  table.finish();
  return options;
}

/// What a circuit's spacing must not be, once it is a length.
void check_circuit_spacing(const Value& value, double spacing, const Unit& length, Scene scene) {
  if (scene.reconstruct.surface.basis == SurfaceBasis::taxels) {
    value.problem("applies to a grid, but the tractions lie at the taxels",
                  "under [reconstruct], surface = \"grid\"; or remove it");
    return;
  }
  const SensorArray& array = scene.sensor;
  if (array.count < 2 || !(array.pitch > 0.0) || array.depths.empty()) return;
  try {
    const double own = surface(scene).spacing;
    if (spacing < own * (1.0 - 1e-9)) {
      value.problem("is finer than the surface, whose tractions lie " +
                        shortest(length.from_si(own)) + " apart",
                    "as far apart at least; or a finer spacing under [reconstruct]");
      return;
    }
    scene.network.spacing = spacing;
    scene = of_circuit(std::move(scene));
    if (const std::size_t nodes = unknowns(scene) * surface(scene).count;
        nodes > most_circuit_nodes)
      value.problem("makes a circuit of " + std::to_string(nodes) + " nodes, more than " +
                        std::to_string(most_circuit_nodes),
                    "a quarter of the depth resolves all that the pad lets through");
  } catch (const std::invalid_argument&) {  // no array, no surface: said where they stand
  }
}

SensorOfEffects effects_sensor(const Read& read, const SensorArray& array) {
  return {.units = read.units,
          .on_offer = {line_quantities.begin(), line_quantities.end()},
          .reads = array.reads,
          .reads_complete = read.reads_complete,
          .taxels = array.count,
          .timed = read.timed};
}

}  // namespace

void read_sections(Table& root, const std::filesystem::path& folder, Scene& scene) {
  scene.title = read_title(root);
  Read read;
  if (const auto table = table_of(root.value("units"))) {
    scene.units = read_units(*table, Dimension::force);
    read.units = *scene.units;
  }
  if (const auto table = table_of(root.required(
          "sensor", "it says where the taxels are and what they read: count, pitch, depth, reads")))
    scene.sensor = read_sensor(*table, folder, read);
  if (const auto table = table_of(root.required(
          "material", "it says what the pad is made of: youngs_modulus, poisson_ratio")))
    scene.material = read_material(*table, scene.sensor.depths, read.units);
  const auto time = root.value("time");
  read.timed = time.has_value();
  if (const auto table = table_of(time)) scene.time = read_time(*table);
  if (const auto contacts = root.value("contact"))
    if (auto tables = contacts->tables()) read_contacts(std::move(*tables), read, scene);
  read_sensor_effects(root, effects_sensor(read, scene.sensor), scene.time, scene);
  const bool understood = read.reads_complete && read.depths_complete && scene.sensor.count > 0;
  scene.calibration = read_calibration(
      table_of(root.value("calibration")), folder,
      understood ? calibrated_readings(scene.sensor, read.units) : CalibratedReadings{});
  if (const auto table = table_of(root.value("calibrate")))
    static_cast<void>(read_calibrate(*table, read.units, scene.material.layer.has_value(), false));
  if (const auto table = table_of(root.value("forward")))
    scene.forward = read_forward(*table, is_even(scene.sensor));

  if (!scene.sensor.depths.empty())
    scene.reconstruct.smoothing_length =
        is_even(scene.sensor) ? scene.sensor.depths.front() : least_depth(scene.sensor);
  scene.reconstruct.surface.basis = default_basis(scene, false);
  if (const auto table = table_of(root.value("reconstruct")))
    scene.reconstruct = read_reconstruct(*table, scene, read);
  scene.network = read_network(root, read.units, alpha_unit(read.units, scene),
                               [&](const Value& value, double spacing) {
                                 check_circuit_spacing(value, spacing, read.units.length, scene);
                               });
  root.finish();
  scene = at_frame(std::move(scene), scene.time ? scene.time->frames - 1 : 0);
}

}  // namespace tactile_net
