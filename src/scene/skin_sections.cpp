#include "scene/skin_sections.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/references.hpp"
#include "scene/taxel_table.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"

namespace tactile_net {
namespace {

/// What scenes of lines have, and skins not yet.
struct Absent {
  std::string_view key;
  std::string_view why;
};
constexpr Absent absent_tables[] = {
    {"network", "is a circuit, and those of skins are not generated yet"},
    {"calibration", "is of line arrays: a skin's recording holds readings"},
    {"viscoelasticity", "is not simulated for skins yet"},
    {"hysteresis", "is not simulated for skins yet"},
    {"crosstalk", "is not simulated for skins yet"},
    {"gain_error", "is not simulated for skins yet"},
    {"offset_error", "is not simulated for skins yet"},
    {"temperature", "is not simulated for skins yet"},
    {"low_pass", "is not simulated for skins yet"},
    {"sampling", "is not simulated for skins yet"},
    {"taxel_noise", "is not simulated for skins yet"},
    {"saturation", "is not simulated for skins yet"},
    {"quantization", "is not simulated for skins yet"},
    {"stuck_taxels", "is not simulated for skins yet"}};
constexpr Absent absent_keys[] = {
    {"surface", "has one kind for skins, a grid of cells"},
    {"offset", "is not estimated for skins yet"},
    {"contact_friction", "is of the method \"dft\", which is for line arrays"},
    {"noise_gain_limit", "is of the method \"dft\", which is for line arrays"},
    {"tangential_weight", "is 1 for skins"},
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

std::map<SkinQuantity, double> read_rms(const Value& value, const SkinScene& scene,
                                        const Read& read) {
  std::map<SkinQuantity, double> rms;
  const auto unit = [&](SkinQuantity quantity) {
    return traits(quantity).kind == QuantityKind::stress         ? read.units.stress
           : traits(quantity).kind == QuantityKind::displacement ? read.units.length
                                                                 : Unit{};
  };
  const auto& reads = scene.sensor.reads;
  if (!value.is_table()) {
    const auto same_unit = [&](SkinQuantity quantity) {
      return traits(quantity).kind == traits(reads.front()).kind;
    };
    if (!std::all_of(reads.begin(), reads.end(), same_unit))
      value.problem("is of readings that differ in kind",
                    "one for each quantity: rms = { stress_x = 20.0, strain_y = 1e-4 }");
    for (const SkinQuantity quantity : reads)
      if (const auto number = value.number(not_negative, unit(quantity))) rms[quantity] = *number;
    return rms;
  }
  auto table = value.table();
  for (const SkinQuantity quantity : skin_quantities) {
    const bool is_read = std::find(reads.begin(), reads.end(), quantity) != reads.end();
    const auto one =
        is_read ? table->required(name(quantity), "the table names every quantity that is read")
                : table->value(name(quantity));
    if (!one) continue;
    if (!is_read && is_whole(scene))
      one->problem("is of a quantity that sensor.reads does not name", "remove it");
    else if (const auto number = one->number(positive, unit(quantity)))
      rms[quantity] = *number;
  }
  table->finish();
  return rms;
}

SkinNoise read_noise(Table table, const SkinScene& scene, const Read& read) {
  SkinNoise noise;
  if (const auto rms = table.required(
          "rms", "the noise of one reading, in its unit: rms = 20.0, or one for each quantity")) {
    noise.weights_rows = rms->is_table();
    noise.rms = read_rms(*rms, scene, read);
  }
  if (const auto seed = table.value("seed"))
    noise.seed = static_cast<std::uint64_t>(seed->integer(0, INT64_MAX).value_or(1));
  table.finish();
  return noise;
}

std::vector<std::size_t> read_dead_taxels(Table table, const SkinScene& scene) {
  std::vector<std::size_t> dead;
  const auto indices =
      table.required("indices", "which taxels, from 0, row after row: indices = [3, 17]");
  const auto last = static_cast<std::int64_t>(
      is_whole(scene) ? taxel_count(scene.sensor) - 1 : static_cast<std::size_t>(most_taxels));
  if (indices)
    for (const Value& item : indices->list("taxel numbers").value_or(std::vector<Value>{})) {
      const auto index = item.integer(
          0, last, "taxels are numbered from 0, row after row: row * columns + column");
      if (!index) break;
      const auto taxel = static_cast<std::size_t>(*index);
      if (std::find(dead.begin(), dead.end(), taxel) != dead.end())
        item.misfit("names a taxel twice", "remove one");
      else
        dead.push_back(taxel);
    }
  if (indices && is_whole(scene) && dead.size() == taxel_count(scene.sensor))
    indices->problem("leaves no taxel alive", "at least one taxel must read something");
  table.finish();
  return dead;
}

/// (weighted readings over tractions) squared.
Unit alpha_unit(const Units& units, const SkinScene& scene) {
  const bool weighted = scene.noise && scene.noise->weights_rows;
  const QuantityKind kind =
      scene.sensor.reads.empty() ? QuantityKind::stress : traits(scene.sensor.reads.front()).kind;
  if (!weighted && kind == QuantityKind::stress) return {};
  const Unit& stress = units.stress;
  Unit one = inverse(stress);
  if (!weighted && kind == QuantityKind::displacement)
    one = {"", one.multiplier * units.length.multiplier, one.divisor * units.length.divisor};
  return {"", one.multiplier * one.multiplier, one.divisor * one.divisor};
}

void read_grid(Table& table, const Read& read, SkinScene& scene) {
  const auto spacing = table.value("spacing");
  const auto margin = table.value("margin");
  SkinGridOptions& options = scene.reconstruct.grid;
  if (spacing) options.spacing = spacing->number(positive, read.units.length);
  if (margin) options.margin = margin->number(not_negative, read.units.length);
  const auto& named = spacing ? spacing : margin ? margin : read.reads;
  if (!named || !is_whole(scene)) return;
  refuse_at(*named, "makes no grid: ", "spacing = half of the depth", [&] {
    const std::size_t unknowns = components(scene) * grid(scene).count();
    if (unknowns > most_skin_tractions)
      named->problem("makes " + std::to_string(unknowns) + " unknown tractions, more than " +
                         std::to_string(most_skin_tractions),
                     "a wider reconstruct.spacing: half of the depth resolves what the pad lets "
                     "through");
  });
}

void read_reconstruct(Table table, const Read& read, SkinScene& scene) {
  SkinReconstructOptions& options = scene.reconstruct;
  if (const auto methods = table.value("methods")) {
    constexpr std::string_view one[] = {"tikhonov"};
    for (const Value& method : methods->list("methods").value_or(std::vector<Value>{}))
      (void)method.one_of("method of skins", one);
  }
  const bool noisy = scene.noise && std::any_of(scene.noise->rms.begin(), scene.noise->rms.end(),
                                                [](const auto& rms) { return rms.second > 0.0; });
  if (const auto alpha = table.value("alpha"))
    read_alpha(*alpha, alpha_unit(read.units, scene), noisy, options.alpha, options.alpha_rule);
  if (const auto length = table.value("smoothing_length"))
    options.smoothing_length = length->number(not_negative, read.units.length);
  const bool one_channel = is_whole(scene) && channel_count(scene.sensor) == 1;
  constexpr const char* three =
      "read what tells drags, such as reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]";
  if (const auto nonnegative = table.value("nonnegative"))
    options.nonnegative = nonnegative->boolean().value_or(false);
  if (const auto limit = table.value("friction_limit")) {
    options.friction_limit = limit->number(positive);
    if (one_channel)
      limit->problem("bounds the drags, which one quantity at one depth cannot tell", three);
  }
  if (const auto tangential = table.value("tangential")) {
    options.tangential = tangential->boolean();
    if (options.tangential == true && one_channel)
      tangential->problem("asks for drags that one quantity at one depth cannot tell", three);
    if (options.tangential == false && options.friction_limit)
      tangential->problem("leaves out the drags that friction_limit bounds", "remove one");
  }
  for (const Absent& absent : absent_keys) table.not_here(absent.key, absent.why, "remove it");
  read_grid(table, read, scene);
  table.finish();
}

/// What the sensor cannot read of this pad, and what cannot be added without the noise.
void check_reads(const Read& read, const SkinScene& scene) {
  if (!is_whole(scene) || !read.reads) return;
  refuse_at(*read.reads, "names what this pad does not give: ", "base = \"bonded\", or other reads",
            [&] {
              for (const SkinQuantity quantity : scene.sensor.reads)
                for (std::size_t c = 0; c < components(scene); ++c)
                  check_quantity(quantity, skin_tractions[c], scene.material);
            });
  const auto& reads = scene.sensor.reads;
  const bool weighted = scene.noise && scene.noise->weights_rows;
  const auto alike = [&](SkinQuantity quantity) {
    return traits(quantity).kind == traits(reads.front()).kind;
  };
  if (!weighted && !std::all_of(reads.begin(), reads.end(), alike))
    read.reads->problem(
        "mixes stresses, strains and displacements, whose errors can only be added if noise.rms "
        "says how large each is",
        "under [noise], rms = { stress_x = 20.0, displacement_y = 1e-6 }: one for each quantity");
}

}  // namespace

bool is_skin(const toml::table& scene, const std::filesystem::path& folder) {
  const toml::table* sensor = scene["sensor"].as_table();
  if (sensor == nullptr) return false;
  if (sensor->contains("rows") || sensor->contains("columns")) return true;
  const auto file = (*sensor)["taxels"].value<std::string>();
  const References references{folder.empty() ? "." : folder};
  return file && !file->empty() && references.allow(*file) &&
         has_column(references.folder / *file, "z");
}

void read_skin_sections(Table& root, const std::filesystem::path& folder, SkinScene& scene) {
  scene.title = read_title(root);
  Read read;
  read.units.force = {.name = "N"};
  if (const auto table = table_of(root.value("units"))) {
    scene.units = read_units(*table, Dimension::point_force);
    read.units = *scene.units;
  }
  if (const auto table = table_of(root.required(
          "sensor",
          "it says where the taxels are and what they read: rows, columns, pitch, depth, reads")))
    scene.sensor = read_skin_sensor(*table, folder, read);
  if (const auto table = table_of(root.required(
          "material", "it says what the pad is made of: youngs_modulus, poisson_ratio")))
    scene.material = read_material(*table, scene.sensor.depths, read.units);
  const auto time = root.value("time");
  read.timed = time.has_value();
  if (const auto table = table_of(time)) scene.time = read_time(*table);
  if (const auto contacts = root.value("contact"))
    if (auto tables = contacts->tables()) read_skin_contacts(std::move(*tables), read, scene);
  if (const auto table = table_of(root.value("noise")))
    scene.noise = read_noise(*table, scene, read);
  if (const auto table = table_of(root.value("dead_taxels")))
    scene.dead_taxels = read_dead_taxels(*table, scene);
  if (const auto table = table_of(root.value("forward")))
    scene.forward = read_forward(*table, true);
  if (auto table = table_of(root.value("reconstruct"))) read_reconstruct(*table, read, scene);
  for (const Absent& absent : absent_tables) root.not_here(absent.key, absent.why, "remove it");
  check_reads(read, scene);
  root.finish();
  scene = at_frame(std::move(scene), scene.time ? scene.time->frames - 1 : 0);
}

}  // namespace tactile_net
