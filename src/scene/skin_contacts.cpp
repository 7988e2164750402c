#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "scene/degrees.hpp"
#include "scene/skin_sections.hpp"

namespace tactile_net {
namespace {

constexpr std::array indenters = {SkinShape::sphere, SkinShape::ellipsoid, SkinShape::punch,
                                  SkinShape::cone};

/// Those of the indenters in their order, then the one that is none.
std::array<std::string_view, indenters.size() + 1> skin_shape_names() {
  std::array<std::string_view, indenters.size() + 1> names;
  std::transform(indenters.begin(), indenters.end(), names.begin(),
                 [](SkinShape shape) { return name(shape); });
  names.back() = "tractions";
  return names;
}

constexpr auto indenter_keys = {"place",    "radius",    "radii", "angle",   "force",
                                "friction", "direction", "stick", "torsion", "trajectory"};
constexpr auto patch_keys = {"spacing", "normal", "tangential_y", "tangential_z"};

/// A number of a contact that may also stand in the knots of a trajectory.
struct ContactKey {
  std::string_view name;
  double SkinContact::*member;
  const Rule* rule;
  Unit (*unit)(const Units& units);
};

constexpr Unit no_unit(const Units&) { return {}; }
constexpr Unit length_unit(const Units& units) { return units.length; }
constexpr Unit force_unit(const Units& units) { return units.force; }
constexpr Unit angle_unit(const Units&) { return degrees; }
constexpr Unit moment_unit(const Units& units) {
  return {"", units.force.multiplier * units.length.multiplier,
          units.force.divisor * units.length.divisor};
}

constexpr ContactKey contact_keys[] = {
    {"radius", &SkinContact::radius, &positive, length_unit},
    {"angle", &SkinContact::angle, &any_number, angle_unit},
    {"force", &SkinContact::force, &not_negative, force_unit},
    {"friction", &SkinContact::friction, &not_negative, no_unit},
    {"direction", &SkinContact::direction, &any_number, angle_unit},
    {"stick", &SkinContact::stick, &proper_fraction, no_unit},
    {"torsion", &SkinContact::torsion, &any_number, moment_unit}};

/// A key that must be there, and what it says.
using Needed = std::pair<std::string_view, std::string_view>;

/// Puts into `contact` what the table names. @return  all of it was understood
bool read_numbers(Table& table, const Units& units, SkinContact& contact) {
  bool good = true;
  const auto two = [&](std::string_view key, const Rule& rule, std::string_view example,
                       double& first, double& second) {
    const auto value = table.value(key);
    if (!value) return;
    const auto both = read_two(*value, rule, units.length, example);
    good = good && both;
    if (both) std::tie(first, second) = std::pair(both->front(), both->back());
  };
  two("place", any_number, "place = [1.0, -0.5]", contact.y, contact.z);
  for (const ContactKey& key : contact_keys)
    if (const auto value = table.value(key.name)) {
      const auto number = value->number(*key.rule, key.unit(units));
      good = good && number;
      contact.*key.member = number.value_or(contact.*key.member);
    }
  two("radii", positive, "radii = [3.0, 2.0]", contact.radius, contact.second_radius);
  return good;
}

/// The library's rules for the whole; what it says is put at `where`.
///
/// @param place  the value that puts it there
void check_contact(const SkinContact& contact, const SkinScene& scene, const Value& where,
                   const std::optional<Value>& place) {
  try {
    check(SkinLoad(contact));
  } catch (const std::invalid_argument& error) {
    where.problem("makes no contact: " + std::string(error.what()));
    return;
  }
  if (scene.sensor.rows == 0) return;
  const SkinSupport part = support(contact);
  SkinSupport skin{0.0, 0.0, 0.0, 0.0};
  const std::vector<Site> all = sites(scene.sensor);
  skin = {all.front().y, all.front().y, all.front().z, all.front().z};
  double reach = 0.0;
  for (const Site& site : all) {
    skin.from_y = std::min(skin.from_y, site.y);
    skin.to_y = std::max(skin.to_y, site.y);
    skin.from_z = std::min(skin.from_z, site.z);
    skin.to_z = std::max(skin.to_z, site.z);
    reach = std::max(reach, site.depth);
  }
  if (part.from_y > skin.to_y + reach || part.to_y < skin.from_y - reach ||
      part.from_z > skin.to_z + reach || part.to_z < skin.from_z - reach)
    place.value_or(where).problem(
        "puts the contact beside the skin, further from every taxel than it is deep",
        "move it, or give the skin more taxels");
}

SkinContactTrajectory read_knots(const Value& trajectory, const std::vector<Needed>& needed,
                                 const SkinContact& contact, bool understood,
                                 const SkinScene& scene, const Read& read) {
  SkinContactTrajectory knots;
  if (!read.timed)
    trajectory.problem("moves the contact over time, and this scene has none",
                       "add [time], duration = 1.0, rate = 100.0");
  auto tables = trajectory.tables();
  if (!tables) return {};
  if (tables->empty())
    trajectory.problem("must hold at least one knot",
                       "trajectory = [{ t = 0.0, force = 0.0 }, { t = 1.0, force = 1.0 }]");
  for (Table& table : *tables) {
    SkinContactKnot knot{.contact = knots.empty() ? contact : knots.back().contact};
    const auto t = table.required("t", "when, in seconds from the first frame: t = 0.5");
    if (t) {
      knot.time = t->number(not_negative, in_seconds).value_or(0.0);
      if (!knots.empty() && knot.time <= knots.back().time)
        t->misfit("must be later than the knot before",
                  "a jump is two knots a moment apart: t = 1.0, then t = 1.001");
    }
    if (knots.empty())
      for (const auto& [key, hint] : needed)
        if (!table.required(key, hint)) understood = false;
    const auto place = table.value("place");
    understood = read_numbers(table, read.units, knot.contact) && understood;
    table.finish();
    if (t && understood) check_contact(knot.contact, scene, *t, place);
    knots.push_back(knot);
  }
  return knots;
}

SkinContact read_rigid(Table& table, const Value& where, SkinShape shape, const SkinScene& scene,
                       const Read& read, SkinContactTrajectory& trajectory) {
  SkinContact contact{.shape = shape};
  const auto moves = table.value("trajectory");
  std::vector<Needed> in_knots;  // what must stand in the first knot
  bool complete = true;
  const auto needs = [&](std::string_view key, std::string_view hint) {
    if (!moves)
      complete = table.required(key, hint).has_value() && complete;
    else if (!table.value(key))
      in_knots.emplace_back(key, hint);
  };
  if (shape == SkinShape::ellipsoid) {
    needs("radii", "half the length and half the width of the contact: radii = [3.0, 2.0]");
    table.not_here("radius", "applies to round contacts; an ellipsoid has two radii",
                   "radii = [3.0, 2.0]");
  } else {
    needs("radius", "of the circle of contact, in the unit of pitch: radius = 2.0");
    for (const std::string_view key : {"radii", "angle"})
      table.not_here(key, "applies to the shape \"ellipsoid\" only", "remove it");
  }
  if (shape == SkinShape::punch)
    table.not_here("stick", "leaves a punch no finite drag: its pressure is infinite at its rim",
                   "remove it");
  needs("force", "the load in the unit of force: force = 1.0");
  for (const std::string_view key : patch_keys)
    table.not_here(key, "applies to the shape \"tractions\" only",
                   "remove it, or give the load by shape = \"tractions\"");
  const auto place = table.value("place");
  const bool understood = read_numbers(table, read.units, contact) && complete;
  if (moves)
    trajectory = read_knots(*moves, in_knots, contact, understood, scene, read);
  else if (understood)
    check_contact(contact, scene, where, place);
  return trajectory.empty() ? contact : trajectory.front().contact;
}

/// A list of rows, each a list of numbers; every field as large as the first.
std::vector<double> read_field(const Value& value, const Unit& stress, SampledPatch& patch) {
  std::vector<double> all;
  const auto rows = value.list("rows, each a list of numbers");
  if (!rows) return all;
  if (rows->empty()) {
    value.problem("must hold at least one row", "normal = [[0.0, 1.0], [1.0, 2.0]]");
    return all;
  }
  for (const Value& row : *rows) {
    if (!row.is_list()) {
      value.problem("must be a list of rows, each a list of numbers",
                    "one row stands in brackets of its own: normal = [[0.0, 1.0]]");
      return {};
    }
    const auto numbers = row.numbers(any_number, stress);
    if (!numbers) return {};
    if (patch.columns == 0) patch.columns = numbers->size();
    if (numbers->size() != patch.columns || numbers->empty()) {
      row.problem("must have as many numbers as the first row: " + std::to_string(patch.columns) +
                  " (got " + std::to_string(numbers->size()) + ')');
      return {};
    }
    all.insert(all.end(), numbers->begin(), numbers->end());
  }
  if (patch.rows == 0) patch.rows = rows->size();
  if (rows->size() == patch.rows) return all;
  value.problem("must have as many rows as normal: " + std::to_string(patch.rows) + " (got " +
                std::to_string(rows->size()) + ')');
  return {};
}

SampledPatch read_tractions(Table& table, const Read& read) {
  SampledPatch patch;
  for (const std::string_view key : indenter_keys)
    if (key != std::string_view("place"))
      table.not_here(key, "does not apply to the shape \"tractions\"",
                     "its load is normal, tangential_y and tangential_z, a number for each cell");
  if (const auto place = table.value("place"))
    if (const auto at = read_two(*place, any_number, read.units.length, "place = [1.0, -0.5]")) {
      patch.y = at->front();
      patch.z = at->back();
    }
  if (const auto spacing =
          table.required("spacing", "of the cells, or two along y and z: spacing = 0.5")) {
    if (!spacing->is_list())
      patch.spacing_y = patch.spacing_z =
          spacing->number(positive, read.units.length).value_or(1.0);
    else if (const auto both =
                 read_two(*spacing, positive, read.units.length, "spacing = [0.5, 0.5]"))
      std::tie(patch.spacing_y, patch.spacing_z) = std::pair(both->front(), both->back());
  }
  const std::pair<std::string_view, std::vector<double> SampledPatch::*> fields[] = {
      {"normal", &SampledPatch::normal},
      {"tangential_y", &SampledPatch::tangential_y},
      {"tangential_z", &SampledPatch::tangential_z}};
  for (const auto& [key, member] : fields) {
    const auto value = key == "normal"
                           ? table.required(key,
                                            "the traction of every cell, a list for each row "
                                            "along y: normal = [[0.0, 1.0], [1.0, 2.0]]")
                           : table.value(key);
    if (value) patch.*member = read_field(*value, read.units.stress, patch);
  }
  return patch;
}

/// Without a shape nothing can be said about the other keys but that they exist.
void pass_over_skin_contact(Table& table) {
  for (const std::string_view key : indenter_keys) (void)table.value(key);
  for (const std::string_view key : patch_keys) (void)table.value(key);
}

}  // namespace

void read_skin_contacts(std::vector<Table> tables, const Read& read, SkinScene& scene) {
  for (Table& table : tables) {
    const auto shape = table.required(
        "shape",
        "how the load is spread: \"sphere\", \"ellipsoid\", \"punch\", \"cone\" or \"tractions\"");
    const auto index = shape ? shape->one_of("shape", skin_shape_names()) : std::nullopt;
    SkinContactTrajectory trajectory;
    if (!index)
      pass_over_skin_contact(table);
    else if (*index == indenters.size())
      scene.contacts.emplace_back(read_tractions(table, read));
    else
      scene.contacts.emplace_back(
          read_rigid(table, *shape, indenters[*index], scene, read, trajectory));
    table.finish();
    scene.trajectories.resize(scene.contacts.size());
    if (!trajectory.empty()) scene.trajectories.back() = std::move(trajectory);
  }
}

}  // namespace tactile_net
