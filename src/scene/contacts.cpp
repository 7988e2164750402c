// The list of contacts: one reader, whose shapes say which sensors they press on.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "scene/degrees.hpp"
#include "scene/sections.hpp"

namespace tactile_net {
namespace {

/// A shape, and what it is on each sensor; absent: none. "tractions" are given on both.
struct ContactShape {
  std::string_view name;
  std::optional<Shape> of_line{};
  std::optional<SkinShape> of_skin{};
  const char* instead = "";  ///< on the other sensor
};
constexpr ContactShape contact_shapes[] = {
    {"cylinder", Shape::cylinder, {}, "shape = \"sphere\", or \"ellipsoid\" for a long contact"},
    {"sphere", {}, SkinShape::sphere, "shape = \"cylinder\", whose pressure is Hertz' too"},
    {"ellipsoid", {}, SkinShape::ellipsoid, "shape = \"cylinder\", whose pressure is Hertz' too"},
    {"punch", Shape::punch, SkinShape::punch},
    {"wedge", Shape::wedge, {}, "shape = \"cone\""},
    {"cone", {}, SkinShape::cone, "shape = \"wedge\""},
    {"tractions"}};
constexpr const ContactShape& tractions_shape = contact_shapes[std::size(contact_shapes) - 1];

/// A number of a contact, or two in a list, which may also stand in the knots of a trajectory.
template <typename Body>
struct ContactKey {
  std::string_view name;
  double Body::*member;
  const Rule* rule;
  Unit (*unit)(const Units& units);
  double Body::*second = nullptr;  ///< null: it is one number
  const char* example = "";        ///< of two
};

constexpr Unit no_unit(const Units&) { return {}; }
constexpr Unit length_unit(const Units& units) { return units.length; }
constexpr Unit force_unit(const Units& units) { return units.force; }
constexpr Unit angle_unit(const Units&) { return angle_degrees; }
constexpr Unit moment_unit(const Units& units) {
  return {"", units.force.multiplier * units.length.multiplier,
          units.force.divisor * units.length.divisor};
}

constexpr ContactKey<RigidContact> line_keys[] = {
    {"center", &RigidContact::center, &any_number, length_unit},
    {"half_width", &RigidContact::half_width, &positive, length_unit},
    {"force", &RigidContact::force, &not_negative, force_unit},
    {"friction", &RigidContact::friction, &any_number, no_unit}};

constexpr ContactKey<SkinContact> skin_keys[] = {
    {"place", &SkinContact::y, &any_number, length_unit, &SkinContact::z, "place = [1.0, -0.5]"},
    {"radius", &SkinContact::radius, &positive, length_unit},
    {"radii", &SkinContact::radius, &positive, length_unit, &SkinContact::second_radius,
     "radii = [3.0, 2.0]"},
    {"angle", &SkinContact::angle, &any_number, angle_unit},
    {"force", &SkinContact::force, &not_negative, force_unit},
    {"friction", &SkinContact::friction, &not_negative, no_unit},
    {"direction", &SkinContact::direction, &any_number, angle_unit},
    {"stick", &SkinContact::stick, &proper_fraction, no_unit},
    {"torsion", &SkinContact::torsion, &any_number, moment_unit}};

/// A key that must be there, and what it says.
using Needed = std::pair<std::string_view, std::string_view>;

/// What is one sensor's own.
template <typename Kind>
struct Contacts;

template <>
struct Contacts<Scene> {
  using Body = RigidContact;
  static constexpr auto shape = &ContactShape::of_line;
  static constexpr std::span<const ContactKey<Body>> keys = line_keys;
  static constexpr std::array<std::string_view, 2> fields = {"normal", "tangential"};
  static constexpr const char* fields_are =
      "its load is normal and tangential, one value per taxel";
  static constexpr const char* shapes_are = "\"cylinder\", \"punch\", \"wedge\" or \"tractions\"";
  static constexpr const char* for_others = "is a shape for skins, and these taxels are in a line";
  static std::array<Needed, 2> needed(Shape) {
    return {{{"half_width",
              "half the width of the loaded strip, in the unit of pitch: half_width = 2.0"},
             {"force", "the load per unit length out of plane: force = 1.0"}}};
  }
};

template <>
struct Contacts<SkinScene> {
  using Body = SkinContact;
  static constexpr auto shape = &ContactShape::of_skin;
  static constexpr std::span<const ContactKey<Body>> keys = skin_keys;
  static constexpr std::array<std::string_view, 4> fields = {"spacing", "normal", "tangential_y",
                                                             "tangential_z"};
  static constexpr const char* fields_are =
      "its load is normal, tangential_y and tangential_z, a number for each cell";
  static constexpr const char* shapes_are =
      "\"sphere\", \"ellipsoid\", \"punch\", \"cone\" or \"tractions\"";
  static constexpr const char* for_others = "is a shape for lines of taxels, and this is a skin";
  static std::array<Needed, 2> needed(SkinShape shape) {
    const Needed size =
        shape == SkinShape::ellipsoid
            ? Needed{"radii",
                     "half the length and half the width of the contact: radii = [3.0, 2.0]"}
            : Needed{"radius", "of the circle of contact, in the unit of pitch: radius = 2.0"};
    return {{size, {"force", "the load in the unit of force: force = 1.0"}}};
  }
};

/// Keys that only one shape has.
void read_own(Table& table, const Read& read, RigidContact& contact) {
  if (contact.shape != Shape::punch)
    table.not_here("edge", "applies to the shape \"punch\" only", "remove it");
  else if (const auto edge = table.value("edge"))
    contact.edge = edge->number(not_negative, read.units.length).value_or(contact.edge);
}
void read_own(Table& table, const Read&, const SkinContact& contact) {
  if (contact.shape == SkinShape::ellipsoid)
    table.not_here("radius", "applies to round contacts; an ellipsoid has two radii",
                   "radii = [3.0, 2.0]");
  else
    for (const std::string_view key : {"radii", "angle"})
      table.not_here(key, "applies to the shape \"ellipsoid\" only", "remove it");
  if (contact.shape == SkinShape::punch)
    table.not_here("stick", "leaves a punch no finite drag: its pressure is infinite at its rim",
                   "remove it");
}

/// Where the numbers of a contact stand, at one moment.
struct ContactPlaces {
  Value where;  ///< the contact's shape, or the knot's time
  std::optional<Table> own{}, knot{};

  [[nodiscard]] std::optional<Value> value(std::string_view key) {
    auto found = knot ? knot->value(key) : std::nullopt;
    return found ? found : own->value(key);
  }
};

// --- what must be where -------------------------------------------------------------------------

/// Width of the surface that belongs to the taxels; 0: not known.
double loaded_width(const SensorArray& array) {
  return static_cast<double>(array.count) * array.pitch;
}

double middle(const SensorArray& array) {
  return is_even(array) ? 0.0 : 0.5 * (array.taxels.front().y + array.taxels.back().y);
}

/// Both in lengths; the slack lets a contact be exactly as wide as the array in decimal fractions.
bool exceeds(double length, double limit) { return length > limit * (1.0 + 1e-12); }

void check_contact(const RigidContact& contact, const Scene& scene, ContactPlaces& at) {
  const SensorArray& array = scene.sensor;
  const double all = loaded_width(array);
  if (all == 0.0) return;
  const auto center = at.value("center");
  if (exceeds(2.0 * contact.half_width, all))
    at.value("half_width")
        .value_or(at.where)
        .misfit("makes the contact wider than the array (count * pitch)",
                "a smaller half_width, or more taxels");
  else if (center && std::abs(contact.center - middle(array)) - contact.half_width >= all / 2.0)
    center->misfit(is_even(array) ? "puts the contact beside the array, which is centred on 0"
                                  : "puts the contact beside the array",
                   "move it, or give the array more taxels");
}

/// The library's rules for the whole.
void check_contact(const SkinContact& contact, const SkinScene& scene, ContactPlaces& at) {
  try {
    check(SkinLoad(contact));
  } catch (const std::invalid_argument& error) {
    at.where.problem("makes no contact: " + std::string(error.what()));
    return;
  }
  if (taxel_count(scene.sensor) == 0) return;
  const SkinSupport part = support(contact);
  const std::vector<Site> all = sites(scene.sensor);
  SkinSupport skin{all.front().y, all.front().y, all.front().z, all.front().z};
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
    at.value("place").value_or(at.where).problem(
        "puts the contact beside the skin, further from every taxel than it is deep",
        "move it, or give the skin more taxels");
}

// --- bodies that press --------------------------------------------------------------------------

/// Puts into `contact` what the table names. @return  all of it was understood
template <typename Body>
bool read_numbers(Table& table, std::span<const ContactKey<Body>> keys, const Units& units,
                  Body& contact) {
  bool good = true;
  for (const ContactKey<Body>& key : keys) {
    const auto value = table.value(key.name);
    if (!value) continue;
    if (key.second == nullptr) {
      const auto number = value->number(*key.rule, key.unit(units));
      good = good && number;
      contact.*key.member = number.value_or(contact.*key.member);
    } else {
      const auto both = read_two(*value, *key.rule, key.unit(units), key.example);
      good = good && both;
      contact.*key.member = both ? both->front() : contact.*key.member;
      contact.*key.second = both ? both->back() : contact.*key.second;
    }
  }
  return good;
}

/// @param needed      what must stand in the first knot
/// @param understood  what the contact itself says
template <typename Kind, typename Trajectory>
void read_knots(const Value& list, const std::vector<Needed>& needed,
                const typename Contacts<Kind>::Body& contact, bool understood, const Kind& scene,
                const Read& read, ContactPlaces at, Trajectory& knots) {
  if (!read.timed)
    list.problem("moves the contact over time, and this scene has none",
                 "add [time], duration = 1.0, rate = 100.0");
  auto tables = list.tables();
  if (!tables) return;
  if (tables->empty())
    list.problem("must hold at least one knot",
                 "trajectory = [{ t = 0.0, force = 0.0 }, { t = 1.0, force = 1.0 }]");
  for (Table& table : *tables) {
    typename Trajectory::value_type knot{.contact = knots.empty() ? contact : knots.back().contact};
    const auto t = table.required("t", "when, in seconds from the first frame: t = 0.5");
    if (t) {
      knot.time = t->number(not_negative, in_seconds).value_or(0.0);
      if (!knots.empty() && knot.time <= knots.back().time)
        t->misfit("must be later than the knot before",
                  "for a jump write two knots a moment apart: t = 1.0, then t = 1.001");
    }
    if (knots.empty())
      for (const auto& [key, hint] : needed)
        if (!table.required(key, hint)) understood = false;
    understood = read_numbers(table, Contacts<Kind>::keys, read.units, knot.contact) && understood;
    table.finish();
    if (t && understood) {
      at.where = *t;
      at.knot = table;
      check_contact(knot.contact, scene, at);
    }
    knots.push_back(knot);
  }
}

/// @param where  its shape
template <typename Kind, typename Trajectory>
auto read_body(Table& table, const Value& where, typename Contacts<Kind>::Body contact,
               const Kind& scene, const Read& read, Trajectory& trajectory) {
  for (const auto& key : Contacts<Kind>::keys) (void)table.value(key.name);  // their order in hints
  const auto moves = table.value("trajectory");
  read_own(table, read, contact);
  std::vector<Needed> in_knots;
  bool understood = true;
  for (const auto& [key, hint] : Contacts<Kind>::needed(contact.shape)) {
    if (!moves)
      understood = table.required(key, hint).has_value() && understood;
    else if (!table.value(key))
      in_knots.emplace_back(key, hint);
  }
  for (const std::string_view key : Contacts<Kind>::fields)
    table.not_here(key, "applies to the shape \"tractions\" only",
                   "remove it, or give the load by shape = \"tractions\"");
  understood = read_numbers(table, Contacts<Kind>::keys, read.units, contact) && understood;
  ContactPlaces at{.where = where, .own = table};
  if (moves)
    read_knots(*moves, in_knots, contact, understood, scene, read, at, trajectory);
  else if (understood)
    check_contact(contact, scene, at);
  return trajectory.empty() ? contact : trajectory.front().contact;
}

// --- tractions ----------------------------------------------------------------------------------

void check_size(const std::optional<Value>& value, const std::vector<double>& numbers,
                const SensorArray& array) {
  if (array.count == 0 || numbers.size() == array.count) return;
  value->problem("must have one value per taxel: " + std::to_string(array.count) + " (got " +
                 std::to_string(numbers.size()) + ')');
}

SampledTractions read_tractions(Table& table, const Read& read, const Scene& scene) {
  const SensorArray& array = scene.sensor;
  const Unit& stress = read.units.stress;
  SampledTractions contact;
  contact.pitch = array.pitch;
  if (array.count > 0) contact.first = position(array, 0);
  const auto normal = table.required(
      "normal", "the normal traction at every taxel, from the lowest y: normal = [0.0, 0.5, 0.0]");
  const auto tangential = table.value("tangential");
  if (normal && !is_even(array))
    normal->problem("is given at taxels equally far apart, and these are not",
                    "shape = \"cylinder\", \"punch\" or \"wedge\"");
  if (normal) {
    if (auto numbers = normal->numbers(any_number, stress)) {
      check_size(normal, *numbers, array);
      contact.normal = std::move(*numbers);
    }
  }
  if (tangential) {
    if (auto numbers = tangential->numbers(any_number, stress)) {
      check_size(tangential, *numbers, array);
      contact.tangential = std::move(*numbers);
    }
  }
  table.not_here("edge", "applies to the shape \"punch\" only", "remove it");
  return contact;
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

SampledPatch read_tractions(Table& table, const Read& read, const SkinScene&) {
  SampledPatch patch;
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

// --- the list -----------------------------------------------------------------------------------

/// What the text names among the shapes that press on such a sensor; a problem where it names none.
template <typename Kind>
const ContactShape* read_shape(const Value& value) {
  std::vector<const ContactShape*> own;
  std::vector<std::string_view> names;
  for (const ContactShape& shape : contact_shapes) {
    const bool suits = &shape == &tractions_shape || (shape.*Contacts<Kind>::shape).has_value();
    if (!suits && value.is_text() && value.text() == shape.name) {
      value.problem(in_quotes(shape.name) + ' ' + Contacts<Kind>::for_others, shape.instead);
      return nullptr;
    }
    if (suits) {
      own.push_back(&shape);
      names.push_back(shape.name);
    }
  }
  const auto index = value.one_of("shape", names);
  return index ? own[*index] : nullptr;
}

template <SceneKind Kind>
void read_list(std::vector<Table> tables, const Read& read, Kind& scene) {
  for (Table& table : tables) {
    const auto named = table.required(
        "shape", "how the load is spread: " + std::string(Contacts<Kind>::shapes_are));
    const ContactShape* shape = named ? read_shape<Kind>(*named) : nullptr;
    typename decltype(scene.trajectories)::value_type trajectory;
    if (shape == nullptr) {  // of other keys nothing can be said but that they exist
      for (const auto& key : Contacts<Kind>::keys) (void)table.value(key.name);
      for (const std::string_view key : Contacts<Kind>::fields) (void)table.value(key);
      for (const std::string_view key : {"trajectory", "edge"}) (void)table.value(key);
    } else if (shape == &tractions_shape) {
      for (const auto& key : Contacts<Kind>::keys)
        if (key.name != "place")
          table.not_here(key.name, "does not apply to the shape \"tractions\"",
                         Contacts<Kind>::fields_are);
      table.not_here("trajectory", "does not apply to the shape \"tractions\"",
                     Contacts<Kind>::fields_are);
      scene.contacts.emplace_back(read_tractions(table, read, scene));
    } else {
      typename Contacts<Kind>::Body contact;
      contact.shape = *(shape->*Contacts<Kind>::shape);
      scene.contacts.emplace_back(read_body(table, *named, contact, scene, read, trajectory));
    }
    table.finish();
    scene.trajectories.resize(scene.contacts.size());
    if (!trajectory.empty()) scene.trajectories.back() = std::move(trajectory);
  }
}

}  // namespace

void read_contacts(std::vector<Table> tables, const Read& read, Scene& scene) {
  read_list(std::move(tables), read, scene);
}

void read_contacts(std::vector<Table> tables, const Read& read, SkinScene& scene) {
  read_list(std::move(tables), read, scene);
}

}  // namespace tactile_net
