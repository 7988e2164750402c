#include "scene/skin_sections.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/calibration_section.hpp"
#include "scene/references.hpp"
#include "scene/sections.hpp"
#include "scene/taxel_table.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/option_words.hpp"
#include "tactile_net/scene/skin_size.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net {
namespace {

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

/// Complete enough to be asked for more.
bool is_whole(const SkinScene& scene) { return scene.sensor.rows > 0; }

/// A problem at `value` if the library refuses what it is given.
template <typename Call>
void refuse_at(const Value& value, const std::string& what, const std::string& hint, Call call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    value.problem(what + error.what(), hint);
  }
}

SensorOfEffects effects_sensor(const Read& read, const SkinScene& scene) {
  SensorOfEffects sensor{.units = read.units,
                         .on_offer = {skin_quantities.begin(), skin_quantities.end()},
                         .timed = read.timed,
                         .skin = &scene.sensor};
  if (!is_whole(scene)) return sensor;
  sensor.reads = scene.sensor.reads;
  sensor.reads_complete = true;
  sensor.taxels = taxel_count(scene.sensor);
  sensor.most_neighbours = signal_layout(scene.sensor).most_neighbours;
  return sensor;
}

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

void check_grid(const std::optional<Value>& at, const Units& units, const SkinScene& scene) {
  if (!at || !is_whole(scene)) return;
  std::string cells;
  try {
    const SurfaceGrid made = grid(scene);
    const std::size_t unknowns = components(scene) * made.count();
    const std::size_t most = most_tractions(scene);
    if (unknowns <= most) return;
    cells = std::to_string(made.rows) + " x " + std::to_string(made.columns) + " cells with " +
            std::to_string(unknowns) + " unknown tractions, more than " + std::to_string(most);
    if (most == most_skin_tractions && unknowns <= most_large_skin_tractions)
      cells += is_even(scene.sensor) ? " (more need reconstruct.offset = false)"
                                     : " (more need rows and columns of taxels)";
  } catch (const std::invalid_argument& error) {
    cells = error.what();
    cells = cells.substr(0, cells.find(": choose"));
  }
  at->problem("makes too many cells: " + cells, fewer_cells(scene, units));
}

/// @param at  the depths, or what says where the taxels are
void read_grid(Table& table, const std::optional<Value>& at, const Read& read, SkinScene& scene) {
  const auto spacing = table.value("spacing");
  const auto margin = table.value("margin");
  SkinGridOptions& options = scene.reconstruct.grid;
  if (spacing) options.spacing = spacing->number(positive, read.units.length);
  if (margin) options.margin = margin->number(not_negative, read.units.length);
  check_grid(spacing ? spacing : margin ? margin : at, read.units, scene);
}

void read_reconstruct(Table table, const std::optional<Value>& depths, const Read& read,
                      SkinScene& scene) {
  SkinReconstructOptions& options = scene.reconstruct;
  if (const auto methods = table.value("methods")) {
    constexpr std::string_view one[] = {"tikhonov"};
    for (const Value& method : methods->list("methods").value_or(std::vector<Value>{})) {
      if (method.is_text() && method.text() == "network")
        method.problem(
            "asks for a circuit as a method; the circuit of a skin is computed beside the answer",
            "remove it; a run with " + option(Option::realization, "least_squares") + " has both");
      else
        (void)method.one_of("method of skins", one);
    }
  }
  const bool noisy = scene.noise && std::any_of(scene.noise->rms.begin(), scene.noise->rms.end(),
                                                [](const auto& rms) { return rms.second > 0.0; });
  if (const auto alpha = table.value("alpha")) {
    read_alpha(*alpha, alpha_unit(read.units, scene), noisy, options.alpha, options.alpha_rule);
    if (options.alpha_rule == AlphaRule::ncp)
      alpha->problem("looks for white noise along a line of taxels, which a skin is not",
                     noisy ? "alpha = \"evidence\", or \"aicc\"" : "alpha = \"aicc\"");
  }
  if (const auto length = table.value("smoothing_length"))
    options.smoothing_length = length->number(not_negative, read.units.length);
  const bool one_channel = is_whole(scene) && channel_count(scene.sensor) == 1;
  constexpr const char* three =
      "read what tells drags, such as reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]";
  if (const auto nonnegative = table.value("nonnegative"))
    options.nonnegative = nonnegative->boolean().value_or(false);
  if (const auto limit = table.value("friction_limit")) {
    options.friction_limit = limit->number(positive);
    const auto nonnegative = table.value("nonnegative");
    if (nonnegative && !options.nonnegative && nonnegative->boolean())
      nonnegative->problem("lets the surface be pulled, which friction_limit does not",
                           "remove one of the two");
    if (one_channel)
      limit->problem("bounds the drags, which one quantity at one depth cannot tell", three);
  }
  if (const auto weight = table.value("tangential_weight"))
    if (read_tangential_weight(*weight, options.tangential_weight) && one_channel)
      weight->problem("weighs the drags, which one quantity at one depth cannot tell", three);
  if (const auto tangential = table.value("tangential")) {
    options.tangential = tangential->boolean();
    if (options.tangential == true && one_channel)
      tangential->problem("asks for drags that one quantity at one depth cannot tell", three);
    if (options.tangential == false && options.friction_limit)
      tangential->problem("leaves out the drags that friction_limit bounds", "remove one");
  }
  if (const auto offset = table.value("offset")) {
    options.offset = offset->boolean().value_or(false);
    if (options.offset && is_whole(scene) && !is_measured(scene.sensor, scene.dead_taxels, true))
      offset->problem("takes one reading a channel, and no channel has two living taxels",
                      "remove it");
  }
  for (const Absent& absent : absent_keys) table.not_here(absent.key, absent.why, "remove it");
  read_grid(table, depths, read, scene);
  table.finish();
}

/// What a circuit's spacing must not be, once it is a length.
void check_circuit_spacing(const Value& value, double spacing, const Unit& length,
                           const SkinScene& scene) {
  if (!is_whole(scene)) return;
  try {
    const SurfaceGrid own = grid(scene);
    const double cells = std::min(own.spacing_y, own.spacing_z);
    if (spacing < cells * (1.0 - 1e-9))
      value.problem(
          "is finer than the cells, which lie " + shortest(length.from_si(cells)) + " apart",
          "as far apart at least; or a finer spacing under [reconstruct]");
  } catch (const std::invalid_argument&) {  // no grid: said where it stands
  }
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
  if (!is_whole(scene) || !read.reads) return;
  refuse_at(*read.reads, "names what this pad does not give: ", "base = \"bonded\", or other reads",
            [&] {
              for (const Quantity quantity : scene.sensor.reads)
                for (std::size_t c = 0; c < components(scene); ++c)
                  check_quantity(quantity, skin_tractions[c], scene.material);
            });
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

}  // namespace

namespace {

/// What a scene of a line cannot say. For those whose file of taxels does not tell.
bool speaks_of_a_skin(const toml::table& scene) {
  const auto any_of = [](const toml::node* list, const auto& is) {
    const toml::array* all = list != nullptr ? list->as_array() : nullptr;
    return all != nullptr && std::any_of(all->begin(), all->end(), is);
  };
  const auto of_skins_alone = [](const toml::node& read) {
    const auto text = read.value<std::string>();
    return text && quantity_named(*text) && !quantity_named(*text, line_quantities);
  };
  const auto has_place = [](const toml::node& contact) {
    const toml::table* table = contact.as_table();
    return table != nullptr && table->contains("place");
  };
  const auto force = scene["units"]["force"].value<std::string>();
  const auto points = units_of(Dimension::point_force);
  return any_of(scene["sensor"]["reads"].node(), of_skins_alone) ||
         any_of(scene["contact"].node(), has_place) ||
         (force && std::any_of(points.begin(), points.end(),
                               [&](const Unit& unit) { return unit.name == *force; }));
}

}  // namespace

bool is_skin(const toml::table& scene, const std::filesystem::path& folder) {
  const toml::table* sensor = scene["sensor"].as_table();
  if (sensor == nullptr) return false;
  if (sensor->contains("rows") || sensor->contains("columns")) return true;
  const auto file = (*sensor)["taxels"].value<std::string>();
  const References references{folder.empty() ? "." : folder};
  if (!file || file->empty() || !references.allow(*file)) return false;
  return has_column(references.folder / *file, "z") || speaks_of_a_skin(scene);
}

void read_skin_sections(Table& root, const std::filesystem::path& folder, SkinScene& scene) {
  scene.title = read_title(root);
  Read read;
  read.units.force = {.name = "N"};
  if (const auto table = table_of(root.value("units"))) {
    scene.units = read_units(*table, Dimension::point_force);
    read.units = *scene.units;
  }
  const auto sensor =
      root.required("sensor",
                    "it says where the taxels are and what they read: rows, columns, pitch, depth, "
                    "reads");
  if (const auto table = table_of(sensor)) scene.sensor = read_skin_sensor(*table, folder, read);
  if (const auto table = table_of(root.required(
          "material", "it says what the pad is made of: youngs_modulus, poisson_ratio")))
    scene.material = read_material(*table, scene.sensor.depths, read.units);
  const auto time = root.value("time");
  read.timed = time.has_value();
  if (const auto table = table_of(time)) scene.time = read_time(*table);
  if (const auto contacts = root.value("contact"))
    if (auto tables = contacts->tables()) read_skin_contacts(std::move(*tables), read, scene);
  read_sensor_effects(root, effects_sensor(read, scene), scene.time, scene);
  scene.calibration = read_calibration(
      table_of(root.value("calibration")), folder,
      is_whole(scene) ? calibrated_readings(scene.sensor, read.units) : CalibratedReadings{});
  const auto calibrate = root.value("calibrate");
  if (const auto table = table_of(calibrate)) {
    const CalibrationOptions stated =
        read_calibrate(*table, read.units, scene.material.layer.has_value(), true);
    if (stated.pitch_sd > 0.0 && is_whole(scene) && !is_even(scene.sensor))
      calibrate->problem("asks for a pitch, and these taxels have places of their own",
                         "remove pitch_sd: their places are taken as the file has them");
  }
  if (const auto table = table_of(root.value("forward")))
    scene.forward = read_forward(*table, true);
  const auto depths = depths_in(sensor);
  if (auto table = table_of(root.value("reconstruct")))
    read_reconstruct(*table, depths, read, scene);
  else
    check_grid(depths, read.units, scene);
  scene.network = read_network(root, read.units, alpha_unit(read.units, scene),
                               [&](const Value& value, double spacing) {
                                 check_circuit_spacing(value, spacing, read.units.length, scene);
                               });
  check_reads(read, scene);
  root.finish();
  scene = at_frame(std::move(scene), scene.time ? scene.time->frames - 1 : 0);
}

}  // namespace tactile_net
