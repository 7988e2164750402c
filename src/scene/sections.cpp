#include "scene/sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "scene/calibration_section.hpp"
#include "scene/references.hpp"
#include "scene/taxel_file.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/scale_units.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net {
namespace {

constexpr std::int64_t most_frames = 1'000'000;
constexpr Rule poisson_range{"must be from 0 to 0.5",
                             [](double nu) noexcept { return nu >= 0.0 && nu <= 0.5; }};

Layer read_layer(Table table, std::span<const double> depths, const Unit& length) {
  constexpr std::array bases = {Base::bonded, Base::frictionless};
  Layer layer;
  if (const auto thickness =
          table.required("thickness", "from the surface to the rigid base: thickness = 3.0")) {
    if (const auto h = thickness->number(positive, length)) {
      layer.thickness = *h;
      if (std::any_of(depths.begin(), depths.end(), [=](double depth) { return depth > *h; }))
        thickness->misfit("must be at least the sensors' depth",
                          "sensors lie in the layer, at its base at most");
    }
  }
  if (const auto base = table.required(
          "base", "how the layer is held from below: base = \"bonded\", or \"frictionless\""))
    if (const auto index = base->one_of("base", names_of(bases))) layer.base = bases[*index];
  table.finish();
  return layer;
}

Material read_material(Table table, std::span<const double> depths, const Units& units) {
  Material material;
  if (const auto modulus = table.required(
          "youngs_modulus", "the pad's stiffness, in the unit of stress: youngs_modulus = 1.0"))
    material.youngs_modulus =
        modulus->number(positive, units.modulus).value_or(material.youngs_modulus);
  if (const auto ratio = table.required(
          "poisson_ratio", "from 0 to 0.5, which is incompressible: poisson_ratio = 0.45"))
    material.poisson_ratio = ratio->number(poisson_range).value_or(material.poisson_ratio);
  if (const auto layer = table_of(table.value("layer")))
    material.layer = read_layer(*layer, depths, units.length);
  table.finish();
  return material;
}

Timing read_time(Table table) {
  Timing timing;
  if (const auto rate = table.required("rate", "frames per second: rate = 100.0"))
    timing.rate = rate->number(positive, in_hertz).value_or(timing.rate);
  const auto duration = table.required(
      "duration", "seconds from the first frame to the last: duration = 1.0", {"frames"});
  const auto frames = table.value("frames");
  if (frames && duration) {
    frames->problem("and time.duration exclude each other", "keep one of the two");
  } else if (frames) {
    timing.frames = static_cast<std::size_t>(frames->integer(1, most_frames).value_or(1));
  } else if (duration) {
    const double last =
        duration->number(not_negative, in_seconds).value_or(0.0) * timing.rate + 1e-9;
    if (last < static_cast<double>(most_frames))
      timing.frames = static_cast<std::size_t>(last) + 1;
    else
      duration->misfit("makes more than 1000000 frames at this rate", "a lower rate");
  }
  table.finish();
  return timing;
}

ForwardModel read_forward(Table table, bool even) {
  constexpr std::array models = {ForwardModel::exact, ForwardModel::sampled};
  auto result = ForwardModel::exact;
  if (const auto model = table.value("model"))
    if (const auto index = model->one_of("model", names_of(models))) {
      result = models[*index];
      if (result == ForwardModel::sampled && !even)
        model->problem("sums over " + std::string(equal_taxels), "model = \"exact\"");
    }
  table.finish();
  return result;
}

constexpr Dimension force_on(const Scene&) noexcept { return Dimension::force; }
constexpr Dimension force_on(const SkinScene&) noexcept { return Dimension::point_force; }

constexpr const char* sensor_keys(const Scene&) { return "count, pitch, depth, reads"; }
constexpr const char* sensor_keys(const SkinScene&) { return "rows, columns, pitch, depth, reads"; }

/// Whether sums over the taxels stand for integrals.
bool can_be_sampled(const Scene& scene) { return is_even(scene.sensor); }
bool can_be_sampled(const SkinScene&) { return true; }

SensorOfEffects effects_sensor(const Read& read, const SceneKind auto& scene,
                               std::span<const Quantity> quantities) {
  return {.units = read.units,
          .on_offer = {quantities.begin(), quantities.end()},
          .reads = scene.sensor.reads,
          .reads_complete = read.reads_complete && !scene.sensor.reads.empty(),
          .taxels = taxel_count(scene.sensor),
          .timed = read.timed};
}
SensorOfEffects sensor_of_effects(const Read& read, const Scene& scene) {
  return effects_sensor(read, scene, line_quantities);
}
SensorOfEffects sensor_of_effects(const Read& read, const SkinScene& scene) {
  SensorOfEffects sensor = effects_sensor(read, scene, skin_quantities);
  sensor.skin = &scene.sensor;
  if (read.whole) sensor.most_neighbours = signal_layout(scene.sensor).most_neighbours;
  return sensor;
}

/// Places in a file are not scaled by a pitch.
void check_pitch_deviation(const CalibrationOptions&, const Value&, const Scene&) {}
void check_pitch_deviation(const CalibrationOptions& stated, const Value& at,
                           const SkinScene& scene) {
  if (stated.pitch_sd > 0.0 && !is_even(scene.sensor))
    at.problem("asks for a pitch, and these taxels have places of their own",
               "remove pitch_sd: their places are taken as the file has them");
}

/// How far apart tractions lie, and what messages call them.
std::pair<double, const char*> own_spacing(const Scene& scene) {
  return {surface(scene).spacing, "the surface, whose tractions"};
}
std::pair<double, const char*> own_spacing(const SkinScene& scene) {
  const SurfaceGrid cells = grid(scene);
  return {std::min(cells.spacing_y, cells.spacing_z), "the cells, which"};
}

bool has_places_for_nodes(const Value& value, const Scene& scene) {
  if (scene.reconstruct.surface.basis == SurfaceBasis::taxels)
    value.problem("applies to a grid, but the tractions lie at the taxels",
                  "under [reconstruct], surface = \"grid\"; or remove it");
  return scene.reconstruct.surface.basis != SurfaceBasis::taxels && scene.sensor.pitch > 0.0;
}
bool has_places_for_nodes(const Value&, const SkinScene&) { return true; }

void check_nodes(const Value&, const SkinScene&) {}  // decks are refused by their size
void check_nodes(const Value& value, Scene scene) {
  scene = of_circuit(std::move(scene));
  if (const std::size_t nodes = unknowns(scene) * surface(scene).count; nodes > most_circuit_nodes)
    value.problem("makes a circuit of " + std::to_string(nodes) + " nodes, more than " +
                      std::to_string(most_circuit_nodes),
                  "a quarter of the depth resolves all that the pad lets through");
}

/// What a circuit's spacing must not be, once it is a length.
void check_circuit_spacing(const Value& value, double spacing, const Read& read,
                           SceneKind auto scene) {
  if (!has_places_for_nodes(value, scene) || !read.whole) return;
  try {
    const auto [own, what] = own_spacing(scene);
    if (spacing < own * (1.0 - 1e-9))
      return value.problem("is finer than " + std::string(what) + " lie " +
                               shortest(read.units.length.from_si(own)) + " apart",
                           "as far apart at least; or a finer spacing under [reconstruct]");
    scene.network.spacing = spacing;
    check_nodes(value, std::move(scene));
  } catch (const std::invalid_argument&) {  // no places for tractions: said where they stand
  }
}

/// How much of what the readings leave possible an interval holds.
double read_level(Table table) {
  constexpr Rule inside{"must lie between 0 and 1",
                        [](double x) noexcept { return x > 0.0 && x < 1.0; }};
  double level = SharedScene{}.interval_level;
  if (const auto value = table.value("level")) level = value->number(inside).value_or(level);
  table.finish();
  return level;
}

/// All tables, in the order in which they need one another.
void read_tables(Table& root, const std::filesystem::path& folder, SceneKind auto& scene) {
  scene.title = read_title(root);
  Read read;
  read.units.force = {.name = si_unit(force_on(scene))};
  if (const auto table = table_of(root.value("units"))) {
    scene.units = read_units(*table, force_on(scene));
    read.units = *scene.units;
  }
  const std::string keys = sensor_keys(scene);
  const auto sensor =
      root.required("sensor", "it says where the taxels are and what they read: " + keys);
  const auto surface = root.value("surface");
  if (const auto table = table_of(sensor)) read_sensor(*table, surface, folder, read, scene.sensor);
  read.whole = read.reads_complete && read.depths_complete && taxel_count(scene.sensor) > 0;
  if (const auto table = table_of(root.required(
          "material", "it says what the pad is made of: youngs_modulus, poisson_ratio")))
    scene.material = read_material(*table, scene.sensor.depths, read.units);
  const auto time = root.value("time");
  read.timed = time.has_value();
  if (const auto table = table_of(time)) scene.time = read_time(*table);
  if (const auto contacts = root.value("contact"))
    if (auto tables = contacts->tables()) read_contacts(std::move(*tables), read, scene);
  read_sensor_effects(root, sensor_of_effects(read, scene), scene.time, scene);
  scene.calibration = read_calibration(
      table_of(root.value("calibration")), folder,
      read.whole ? calibrated_readings(scene.sensor, read.units) : CalibratedReadings{});
  const auto calibrate = root.value("calibrate");
  if (const auto table = table_of(calibrate)) {
    const CalibrationOptions stated =
        read_calibrate(*table, read.units, scene.material.layer.has_value(),
                       force_on(scene) == Dimension::point_force);
    if (read.whole) check_pitch_deviation(stated, *calibrate, scene);
  }
  if (const auto table = table_of(root.value("forward")))
    scene.forward = read_forward(*table, can_be_sampled(scene));
  read_reconstruct(table_of(root.value("reconstruct")), sensor, read, folder, scene);
  const Unit alpha = alpha_unit(read.units, scene.noise, scene.sensor.reads);
  scene.network = read_network(
      root, read.units, alpha,
      [&](const Value& value, double spacing) {
        check_circuit_spacing(value, spacing, read, scene);
      },
      folder);
  if (const auto table = table_of(root.value("report"))) scene.interval_level = read_level(*table);
  root.finish();
  scene = at_frame(std::move(scene), scene.time ? scene.time->frames - 1 : 0);
}

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

template <SceneKind Kind>
Kind scene_from(const toml::table& toml, const std::filesystem::path& path, Problems& problems) {
  Kind scene;
  scene.file = path.filename().string();
  Table root{toml, "", problems};
  if (problems.none()) read_tables(root, path.parent_path(), scene);
  return scene;
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

AnyScene scene_in(const toml::table& toml, const std::filesystem::path& path, Problems& problems) {
  if (is_skin(toml, path.parent_path())) return scene_from<SkinScene>(toml, path, problems);
  return scene_from<Scene>(toml, path, problems);
}

std::string read_title(Table& root) {
  const auto title = root.value("title");
  if (!title) return {};
  const std::string text = title->text().value_or("");
  if (text.find_first_of("\r\n") != std::string::npos)
    title->problem("must be one line", "say more in comments");
  return text;
}

}  // namespace tactile_net
