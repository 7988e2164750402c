// The table [reconstruct]: what lines and skins share, then what is each one's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/kernel_file.hpp"
#include "scene/references.hpp"
#include "scene/sections.hpp"
#include "scene/surface_section.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/option_words.hpp"
#include "tactile_net/scene/scale_units.hpp"
#include "tactile_net/scene/skin_size.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {
namespace {

constexpr Rule at_least_one{"must be >= 1", [](double x) noexcept { return x >= 1.0; }};

// --- lines and skins ----------------------------------------------------------------------------

bool is_noisy(const SensorEffects& effects) {
  return effects.noise && std::any_of(effects.noise->rms.begin(), effects.noise->rms.end(),
                                      [](const auto& rms) { return rms.second > 0.0; });
}

constexpr std::string_view second_quantity(const Scene&) {
  return "read a second quantity, such as reads = [\"stress_x\", \"shear_xy\"], or one at two "
         "depths";
}
constexpr std::string_view second_quantity(const SkinScene&) {
  return "read what tells drags, such as reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]";
}

bool has_reading_to_spare(const Scene& scene) {
  return is_measured(scene.sensor, {.dead_taxels = scene.dead_taxels, .unknown_offsets = true});
}
bool has_reading_to_spare(const SkinScene& scene) {
  return is_measured(scene.sensor, scene.dead_taxels, true);
}

/// A number, or "evidence": `weight` is then absent. @return  it was understood
bool read_tangential_weight(const Value& value, std::optional<double>& weight) {
  constexpr std::string_view ways[] = {"evidence"};
  const bool estimated = value.is_text();
  weight = estimated ? std::nullopt : value.number(positive);
  return estimated ? value.one_of("way to estimate a weight", ways).has_value()
                   : weight.has_value();
}

/// A number, or the name of the rule that chooses it.
void read_alpha(const Value& value, const Unit& unit, bool noise_known,
                SharedReconstructOptions& options) {
  if (!value.is_text()) {
    options.alpha = value.number(positive, unit);
    return;
  }
  const auto index = value.one_of("rule", names_of(alpha_rules));
  if (!index) return;
  options.alpha_rule = alpha_rules[*index];
  if (needs_noise(*options.alpha_rule) && !noise_known)
    value.misfit("needs to know the noise",
                 "under [noise], rms = 1e-4, or one for each quantity; or alpha = \"rgcv\"");
}

/// The keys of `SharedReconstructOptions`.
void read_shared(Table& table, const Read& read, SceneKind auto& scene) {
  SharedReconstructOptions& options = scene.reconstruct;
  const auto needs_two_channels = [&](const Value& value, const char* what) {
    if (read.whole && channel_count(scene.sensor) == 1)
      value.problem(std::string(what) + " one quantity at one depth cannot tell",
                    std::string{second_quantity(scene)});
  };
  if (const auto alpha = table.value("alpha"))
    read_alpha(*alpha, alpha_unit(read.units, scene.noise, scene.sensor.reads), is_noisy(scene),
               options);
  if (const auto length = table.value("smoothing_length"))
    if (const auto number = length->number(not_negative, read.units.length))
      scene.reconstruct.smoothing_length = *number;
  const auto nonnegative = table.value("nonnegative");
  const auto may_not_pull = nonnegative ? nonnegative->boolean() : std::nullopt;
  options.nonnegative = may_not_pull.value_or(false);
  if (const auto limit = table.value("friction_limit")) {
    options.friction_limit = limit->number(positive);
    if (may_not_pull == false)
      nonnegative->problem("lets the surface be pulled, which friction_limit does not",
                           "remove one of the two");
    needs_two_channels(*limit, "bounds the tangential traction, which");
  }
  if (const auto weight = table.value("tangential_weight"))
    if (read_tangential_weight(*weight, options.tangential_weight))
      needs_two_channels(*weight, "weighs the tangential traction, which");
  if (const auto tangential = table.value("tangential")) {
    options.tangential = tangential->boolean();
    if (options.tangential == true) needs_two_channels(*tangential, "asks for a traction that");
    if (options.tangential == false && options.friction_limit)
      tangential->problem("leaves out the traction that friction_limit bounds", "remove one");
  }
  if (const auto offset = table.value("offset")) {
    options.offset = offset->boolean().value_or(false);
    if (options.offset && read.whole && !has_reading_to_spare(scene))
      offset->problem("takes one reading a channel, and no channel has two living taxels",
                      "remove it");
  }
}

/// Understood, and knows the noise that it needs; null: neither.
std::optional<Value> read_answer(Table& table, SceneKind auto& scene) {
  constexpr std::array kinds = {AnswerKind::mixture, AnswerKind::alpha};
  auto value = table.value("answer");
  if (!value) return std::nullopt;
  const auto index = value->one_of("answer", names_of(kinds));
  if (!index) return std::nullopt;
  scene.reconstruct.answer = kinds[*index];
  if (kinds[*index] == AnswerKind::alpha) return std::nullopt;
  if (is_noisy(scene)) return value;
  value->misfit("needs to know the noise",
                "under [noise], rms = 1e-4, or one for each quantity; or answer = \"alpha\"");
  return std::nullopt;
}

// --- lines --------------------------------------------------------------------------------------

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

bool uses(const std::vector<NamedMethod>& methods, Method method) {
  return methods.empty() ? method == Method::tikhonov
                         : std::any_of(methods.begin(), methods.end(),
                                       [=](const NamedMethod& n) { return n.method == method; });
}

void read_line_constraints(Table& table, const Read& read, const std::vector<NamedMethod>& methods,
                           Scene& scene) {
  ReconstructOptions& options = scene.reconstruct;
  if (const auto active = table.value("alpha_on_active_set")) {
    options.alpha_on_active_set = active->boolean().value_or(false);
    if (options.alpha_on_active_set && !options.nonnegative && !options.friction_limit)
      active->problem("chooses alpha under constraints, and this scene has none",
                      "friction_limit = 0.8, or nonnegative = true");
    if (options.alpha_on_active_set && options.alpha)
      active->problem("chooses alpha, and this scene gives one", "alpha = \"evidence\"");
  }
  if (const auto friction = table.value("contact_friction")) {
    options.contact_friction = friction->number(any_number);
    if (!uses(methods, Method::dft))
      friction->problem("is used by the method \"dft\" alone, which this scene does not name",
                        "remove it, or add \"dft\" to methods");
    else if (read.whole && channel_count(scene.sensor) > 1)
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

/// How many there are; absent: where they lie is not known.
/// @throw std::invalid_argument  as `surface`
std::optional<std::size_t> tractions_of(const Scene& scene, const Read& read) {
  if (!read.whole || !(scene.sensor.pitch > 0.0)) return std::nullopt;
  return unknowns(scene) * surface(scene).count;
}

void read_surface(Table& table, const Read& read, bool uses_dft, Scene& scene) {
  constexpr std::array bases = {SurfaceBasis::taxels, SurfaceBasis::hats};
  SurfaceOptions& options = scene.reconstruct.surface;
  options.basis = default_basis(scene, uses_dft);
  if (const auto basis = table.value("surface"))
    if (const auto index = basis->one_of("surface", names_of(bases))) {
      options.basis = bases[*index];
      if (uses_dft && options.basis == SurfaceBasis::hats)
        basis->problem(
            "gives tractions where there are no readings, and dft divides one by the other",
            "surface = \"taxels\", or methods without \"dft\"");
      if (options.basis == SurfaceBasis::taxels && !is_even(scene.sensor))
        basis->problem("puts tractions over " + std::string(equal_taxels), "surface = \"grid\"");
    }
  const auto spacing = table.value("spacing");
  const auto margin = table.value("margin");
  for (const auto* length : {&spacing, &margin})
    if (*length && options.basis == SurfaceBasis::taxels)
      (*length)->problem("applies to a grid, but the tractions lie at the taxels",
                         "surface = \"grid\", or remove it");
  if (spacing) options.spacing = spacing->number(positive, read.units.length);
  if (margin) options.margin = margin->number(not_negative, read.units.length);
  if (!spacing && !margin) return;
  const Value& named = spacing ? *spacing : *margin;
  try {
    if (const auto columns = tractions_of(scene, read); columns && *columns > most_columns)
      named.problem("makes " + std::to_string(*columns) + " unknown tractions, more than " +
                        std::to_string(most_columns),
                    "a quarter of the depth resolves all that the pad lets through");
  } catch (const std::invalid_argument& error) {
    named.problem("makes no surface: " + std::string(error.what()),
                  "spacing = a quarter of the depth");
  }
}

/// What unknown offsets ask of a line. After the surface and the methods are known.
void check_offset(const Value& offset, const Scene& scene, const Read& read, bool uses_dft) {
  if (uses_dft)
    offset.problem(
        "makes the mean of the readings unknown, and dft needs it for the mean of the tractions",
        "methods without \"dft\"");
  try {
    if (const auto columns = tractions_of(scene, read); columns && *columns > most_columns)
      offset.problem("takes a decomposition of " + std::to_string(*columns) +
                         " unknown tractions, more than " + std::to_string(most_columns),
                     "remove it, and take the offsets from unloaded frames ([calibration])");
  } catch (const std::invalid_argument&) {  // no surface: said of its spacing
  }
}

// --- skins --------------------------------------------------------------------------------------

/// What reconstructions of lines have, and skins not.
struct Absent {
  std::string_view key;
  std::string_view why;
};
constexpr Absent absent_keys[] = {
    {"surface", "has one kind for skins, a grid of cells"},
    {"contact_friction", "belongs to the method \"dft\", which is for line arrays"},
    {"noise_gain_limit", "belongs to the method \"dft\", which is for line arrays"},
    {"alpha_on_active_set", "is for line arrays"}};

/// What would make fewer cells, with its count.
std::string fewer_cells(const SkinScene& scene, const Units& units) {
  SkinScene other = scene;
  SkinGridOptions& options = other.reconstruct.grid;
  const auto tractions = [&]() -> std::optional<std::size_t> {
    try {
      const std::size_t count = components(other) * grid(other).count();
      return count <= most_tractions(scene) ? std::optional(count) : std::nullopt;
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  };
  const auto makes = [&](std::size_t count) {
    return ", which makes " + std::to_string(count) + " unknown tractions";
  };
  if (options.margin) {
    options.margin.reset();
    if (const auto count = tractions())
      return "reconstruct.margin is left out: the depth" + makes(*count);
    options.margin = scene.reconstruct.grid.margin;
  }
  if (options.spacing) {
    options.spacing.reset();
    if (const auto count = tractions())
      return "reconstruct.spacing is left out: the pitch, or half the depth if that is less" +
             makes(*count);
  }
  // Two digits, from the depth on.
  for (int step = 0; step < 3000; ++step) {
    const double spacing = units.length.from_si(least_depth(scene.sensor) * std::pow(1.2, step));
    const std::string text = brief(spacing, 2);
    double rounded = 0.0;
    if (!read_number(text, rounded)) continue;
    options.spacing = units.length.to_si(rounded);
    if (const auto count = tractions()) return "reconstruct.spacing = " + text + makes(*count);
  }
  return "fewer taxels, or taxels nearer to one another";
}

/// Of a curved skin all must lie on its surface, and on what a given kernel knows.
void check_cells(const Value& at, const SurfaceGrid& made, const SkinScene& scene) {
  if (!scene.sensor.curved) return;
  try {
    (void)cells_of(scene.sensor, made);
  } catch (const std::invalid_argument& error) {
    at.problem("makes cells that its surface has not: " + std::string(error.what()),
               "a smaller reconstruct.margin, or taxels of one side alone");
  }
}

void check_grid(const std::optional<Value>& at, const Read& read, const SkinScene& scene) {
  if (!at || !read.whole) return;
  std::string cells;
  try {
    const SurfaceGrid made = grid(scene);
    const std::size_t unknowns = components(scene) * made.count();
    const std::size_t most = most_tractions(scene);
    if (unknowns <= most) {
      check_cells(*at, made, scene);
      return;
    }
    cells = std::to_string(made.rows) + " x " + std::to_string(made.columns) + " cells with " +
            std::to_string(unknowns) + " unknown tractions, more than " + std::to_string(most);
    if (most == most_skin_tractions && unknowns <= most_large_skin_tractions)
      cells += is_even(scene.sensor) ? " (more need reconstruct.offset = false)"
                                     : " (more need rows and columns of taxels)";
  } catch (const std::invalid_argument& error) {
    cells = error.what();
    cells = cells.substr(0, cells.find(": choose"));
  }
  at->problem("makes too many cells: " + cells, fewer_cells(scene, read.units));
}

/// By which cells are sized where nobody says it: the depths, or the file that has them.
std::optional<Value> depths_in(const std::optional<Value>& sensor) {
  auto table = sensor && sensor->is_table() ? sensor->table() : std::nullopt;
  if (!table) return std::nullopt;
  for (const std::string_view key : {"depth", "depths", "taxels"})
    if (auto value = table->value(key)) return value;
  return sensor;
}

/// What the sensor cannot read of this pad, and what cannot be added without the noise.
void check_reads(const Read& read, const SkinScene& scene) {
  if (!read.whole || !read.reads) return;
  try {
    for (const Quantity quantity : scene.sensor.reads)
      for (std::size_t c = 0; c < components(scene); ++c)
        check_quantity(quantity, skin_tractions[c], scene.material);
  } catch (const std::invalid_argument& error) {
    read.reads->problem("names what this pad does not give: " + std::string(error.what()),
                        "base = \"bonded\", or other reads");
  }
  const auto& reads = scene.sensor.reads;
  const bool weighted = scene.noise && scene.noise->weights_rows;
  const auto alike = [&](Quantity quantity) {
    return traits(quantity).kind == traits(reads.front()).kind;
  };
  if (!weighted && !std::all_of(reads.begin(), reads.end(), alike))
    read.reads->problem(
        "mixes stresses, strains and displacements, whose errors can only be added if noise.rms "
        "says how large each is",
        "under [noise], rms = { stress_x = 20.0, displacement_y = 1e-6 }: one for each quantity");
}

void read_skin_methods(const Value& methods) {
  constexpr std::string_view one[] = {"tikhonov"};
  for (const Value& method : methods.list("methods").value_or(std::vector<Value>{})) {
    if (method.is_text() && method.text() == "network")
      method.problem(
          "asks for a circuit as a method; the circuit of a skin is computed beside the answer",
          "remove it; a run with " + option(Option::realization, "least_squares") + " has both");
    else
      (void)method.one_of("method of skins", one);
  }
}

/// By name, or of a file.
void read_kernel(const Value& value, const std::filesystem::path& folder, SkinScene& scene) {
  if (value.is_text() && value.text().value_or("").ends_with(".npz")) {
    const auto path = path_beside(value, folder, "kernel = \"k.npz\"");
    if (!path) return;
    try {
      scene.sensor =
          with_kernel(scene.sensor, read_kernel_file(*path, scene.sensor, scene.material));
    } catch (const std::exception& error) {
      value.problem("names a file that is not in order: " + std::string(error.what()),
                    "docs/kernels.md says what it holds; tools/pad_kernel.py writes one");
      return;
    }
    const auto& given = scene.sensor.curved->given;
    for (const auto& [own, what] : {std::pair(scene.reconstruct.grid.spacing, "spacing"),
                                    std::pair(scene.reconstruct.grid.margin, "margin")})
      if (own && given->rows > 0)
        value.problem(
            "brings its own cells, and reconstruct." + std::string(what) + " asks for others",
            "remove that");
    return;
  }
  if (const auto kernel = one_named<CurvedKernel>(value, "kernel, or file \"k.npz\""))
    scene.sensor = with_kernel(std::move(scene.sensor), *kernel);
}

/// What a curved skin whose scene says nothing of it is weighed by: its displacements hardly tell
/// drags from pressure, and evidence tells the forces of both best.
void weigh_as_curved(SkinScene& scene) {
  SkinReconstructOptions& options = scene.reconstruct;
  if (!scene.sensor.curved || !is_noisy(scene)) return;
  options.tangential_weight.reset();
  if (!options.alpha && !options.alpha_rule) options.alpha_rule = AlphaRule::evidence;
}

/// What curved skins alone have.
void read_curved(Table& table, const Read& read, const std::filesystem::path& folder,
                 SkinScene& scene) {
  const auto of_curved = [&](const Value& value) {
    if (scene.sensor.curved || !read.whole) return scene.sensor.curved != nullptr;
    value.problem("is of a curved skin, whose taxels have places in space and normals",
                  "remove it");
    return false;
  };
  if (const auto about = table.value("moment_about"))
    if (of_curved(*about))
      if (const auto place =
              read_three(*about, any_number, read.units.length, "moment_about = [0.0, 0.0, 0.0]"))
        scene.reconstruct.moment_about = *place;
  if (const auto kernel = table.value("kernel"))
    if (of_curved(*kernel)) read_kernel(*kernel, folder, scene);
}

}  // namespace

void read_reconstruct(std::optional<Table> table, const std::optional<Value>&, const Read& read,
                      const std::filesystem::path&, Scene& scene) {
  ReconstructOptions& options = scene.reconstruct;
  if (!scene.sensor.depths.empty())
    options.smoothing_length =
        is_even(scene.sensor) ? scene.sensor.depths.front() : least_depth(scene.sensor);
  options.surface.basis = default_basis(scene, false);
  if (!table) return;
  std::vector<NamedMethod> methods;
  if (const auto value = table->value("methods")) {
    methods = read_methods(*value);
    options.methods.clear();
    for (const NamedMethod& named : methods) options.methods.push_back(named.method);
  }
  const bool uses_dft = uses(methods, Method::dft);
  read_shared(*table, read, scene);
  if (const auto limit = table->value("noise_gain_limit"))
    options.noise_gain_limit = limit->number(at_least_one).value_or(options.noise_gain_limit);
  read_line_constraints(*table, read, methods, scene);
  if (const auto mixture = read_answer(*table, scene);
      mixture && (methods.size() > 1 || !uses(methods, Method::tikhonov)))
    mixture->problem(
        "is of the method \"tikhonov\" alone, and this scene names others, which are "
        "of one alpha",
        "methods = [\"tikhonov\"], or answer = \"alpha\"");
  read_surface(*table, read, uses_dft, scene);
  if (options.offset) check_offset(*table->value("offset"), scene, read, uses_dft);
  check_methods(methods, scene, read);
  table->finish();
}

void read_reconstruct(std::optional<Table> table, const std::optional<Value>& sensor,
                      const Read& read, const std::filesystem::path& folder, SkinScene& scene) {
  std::optional<Value> sizes_cells = depths_in(sensor);
  if (table) {
    if (const auto methods = table->value("methods")) read_skin_methods(*methods);
    read_shared(*table, read, scene);
    if (scene.reconstruct.alpha_rule == AlphaRule::ncp)
      table->value("alpha")->problem(
          "looks for white noise along a line of taxels, and a skin has no such line",
          is_noisy(scene) ? "alpha = \"evidence\", or \"aicc\"" : "alpha = \"aicc\"");
    if (const auto mixture = read_answer(*table, scene)) {
      const std::size_t readings = channel_count(scene.sensor) * taxel_count(scene.sensor);
      if (read.whole && readings > most_mixture_readings)
        mixture->problem("is of at most " + std::to_string(most_mixture_readings) +
                             " readings, and this skin has " + std::to_string(readings),
                         "answer = \"alpha\"");
    }
    for (const Absent& absent : absent_keys) table->not_here(absent.key, absent.why, "remove it");
    SkinGridOptions& cells = scene.reconstruct.grid;
    if (const auto margin = table->value("margin")) {
      cells.margin = margin->number(not_negative, read.units.length);
      sizes_cells = margin;
    }
    if (const auto spacing = table->value("spacing")) {
      cells.spacing = spacing->number(positive, read.units.length);
      sizes_cells = spacing;
    }
    read_curved(*table, read, folder, scene);
    if (!table->value("tangential_weight")) weigh_as_curved(scene);
    table->finish();
  } else {
    weigh_as_curved(scene);
  }
  check_grid(sizes_cells, read, scene);
  check_reads(read, scene);
}

}  // namespace tactile_net
