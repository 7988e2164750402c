#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "scene/sections.hpp"

namespace tactile_net {

namespace {

// Shape's names in its order, then the one that is no indenter.
constexpr std::array<std::string_view, 4> shape_names = {"cylinder", "punch", "wedge", "tractions"};
constexpr std::size_t tractions_index = 3;

constexpr auto rigid_keys = {"center", "half_width", "force", "friction", "trajectory"};
constexpr auto sampled_keys = {"normal", "tangential"};

/// Width of the surface that belongs to the taxels; 0: not known.
double width(const SensorArray& array) { return static_cast<double>(array.count) * array.pitch; }

double middle(const SensorArray& array) {
  return is_even(array) ? 0.0 : 0.5 * (array.taxels.front().y + array.taxels.back().y);
}

/// Both in lengths; the slack lets a contact be exactly as wide as the array in decimal fractions.
bool exceeds(double length, double limit) { return length > limit * (1.0 + 1e-12); }

/// What one knot of a trajectory says; absent: the contact's own value.
struct KnotValues {
  double time = 0.0;
  std::optional<Value> center{};
  std::optional<Value> half_width{};
  std::optional<Value> force{};
  std::optional<Value> friction{};
};

using KnotValue = std::optional<Value> KnotValues::*;

constexpr std::array<std::pair<std::string_view, KnotValue>, 4> moving = {
    {{"center", &KnotValues::center},
     {"half_width", &KnotValues::half_width},
     {"force", &KnotValues::force},
     {"friction", &KnotValues::friction}}};

std::vector<KnotValues> read_knots(const Value& trajectory) {
  auto tables = trajectory.tables();
  if (!tables) return {};
  if (tables->empty())
    trajectory.problem("must hold at least one knot",
                       "trajectory = [{ t = 0.0, force = 0.0 }, { t = 1.0, force = 1.0 }]");
  std::vector<KnotValues> knots;
  for (Table& table : *tables) {
    KnotValues knot;
    if (const auto t = table.required("t", "when, in seconds from the first frame: t = 0.5")) {
      knot.time = t->number(not_negative, in_seconds).value_or(0.0);
      if (!knots.empty() && knot.time <= knots.back().time)
        t->misfit("must be later than the knot before",
                  "a jump is two knots a moment apart: t = 1.0, then t = 1.001");
    }
    for (const auto& [key, member] : moving) {
      knot.*member = table.value(key);
      if (!knots.empty() && (knots.front().*member).has_value() != (knot.*member).has_value())
        trajectory.problem("must name " + in_quotes(key) + " in every knot, or in none",
                           "what no knot names keeps the contact's own value");
    }
    table.finish();
    knots.push_back(std::move(knot));
  }
  return knots;
}

/// What is wrong counts as harmless: a half width of 0.
void check_place(const RigidContact& contact, const SensorArray& array,
                 const std::optional<Value>& center, const std::optional<Value>& half_width) {
  const double all = width(array);
  if (contact.half_width == 0.0 || all == 0.0) return;
  if (exceeds(2.0 * contact.half_width, all)) {
    if (half_width)
      half_width->misfit("makes the contact wider than the array (count * pitch)",
                         "a smaller half_width, or more taxels");
  } else if (center && std::abs(contact.center - middle(array)) - contact.half_width >= all / 2.0) {
    center->misfit(is_even(array) ? "puts the contact beside the array, which is centred on 0"
                                  : "puts the contact beside the array",
                   "move it, or give the array more taxels");
  }
}

RigidContact read_rigid(Table& table, Shape shape, const SensorArray& array, const Read& read,
                        ContactTrajectory& trajectory) {
  const Unit& length = read.units.length;
  const Unit& load = read.units.force;
  RigidContact contact;
  contact.shape = shape;
  std::vector<KnotValues> knots;
  for (const std::string_view key : rigid_keys) (void)table.value(key);  // their order in hints
  if (const auto value = table.value("trajectory")) {
    if (!read.timed)
      value->problem("moves the contact over time, and this scene has none",
                     "add [time], duration = 1.0, rate = 100.0");
    knots = read_knots(*value);
  }
  const auto moves = [&](KnotValue member) {
    return !knots.empty() && (knots.front().*member).has_value();
  };
  const auto own = [&](std::string_view key, KnotValue member, std::string_view hint) {
    auto value = hint.empty() || moves(member) ? table.value(key) : table.required(key, hint);
    if (value && moves(member))
      value->problem("stands in the knots of the trajectory too", "keep one of the two");
    return value;
  };
  const auto center = own("center", &KnotValues::center, "");
  const auto half_width =
      own("half_width", &KnotValues::half_width,
          "half the width of the loaded strip, in the unit of pitch: half_width = 2.0");
  const auto force =
      own("force", &KnotValues::force, "the load per unit length out of plane: force = 1.0");
  const auto friction = own("friction", &KnotValues::friction, "");

  // What is wrong counts as harmless below: a centre of 0, a half width of 0.
  contact.center = number_or(center, any_number, 0.0, length);
  contact.half_width = number_or(half_width, positive, 0.0, length);
  contact.force = number_or(force, not_negative, contact.force, load);
  contact.friction = number_or(friction, any_number, contact.friction);

  if (shape == Shape::punch) {
    if (const auto edge = table.value("edge"))
      contact.edge = edge->number(not_negative, length).value_or(contact.edge);
  } else {
    table.not_here("edge", "applies to the shape \"punch\" only", "remove it");
  }
  for (const std::string_view key : sampled_keys)
    table.not_here(key, "applies to the shape \"tractions\" only",
                   "remove it, or give the load by shape = \"tractions\"");

  if (knots.empty()) check_place(contact, array, center, half_width);
  for (const KnotValues& knot : knots) {
    RigidContact then = contact;
    then.center = number_or(knot.center, any_number, contact.center, length);
    then.half_width = number_or(knot.half_width, positive, contact.half_width, length);
    then.force = number_or(knot.force, not_negative, contact.force, load);
    then.friction = number_or(knot.friction, any_number, contact.friction);
    check_place(then, array, knot.center ? knot.center : center,
                knot.half_width ? knot.half_width : half_width);
    trajectory.push_back({knot.time, then});
  }
  return contact;
}

void check_size(const std::optional<Value>& value, const std::vector<double>& numbers,
                const SensorArray& array) {
  if (array.count == 0 || numbers.size() == array.count) return;
  value->problem("must have one value per taxel: " + std::to_string(array.count) + " (got " +
                 std::to_string(numbers.size()) + ')');
}

SampledTractions read_tractions(Table& table, const SensorArray& array, const Unit& stress) {
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
  for (const std::string_view key : rigid_keys)
    table.not_here(key, "does not apply to the shape \"tractions\"",
                   "its load is normal and tangential, one value per taxel");
  table.not_here("edge", "applies to the shape \"punch\" only", "remove it");
  return contact;
}

/// Without a shape nothing can be said about the other keys but that they exist.
void pass_over_contact(Table& table) {
  for (const std::string_view key : rigid_keys) (void)table.value(key);
  for (const std::string_view key : sampled_keys) (void)table.value(key);
  (void)table.value("edge");
}

}  // namespace

void read_contacts(std::vector<Table> tables, const Read& read, Scene& scene) {
  for (Table& table : tables) {
    const auto shape = table.required(
        "shape", "how the load is spread: \"cylinder\", \"punch\", \"wedge\" or \"tractions\"");
    const auto index = shape ? shape->one_of("shape", shape_names) : std::nullopt;
    ContactTrajectory trajectory;
    if (!index)
      pass_over_contact(table);
    else if (*index == tractions_index)
      scene.contacts.emplace_back(read_tractions(table, scene.sensor, read.units.stress));
    else
      scene.contacts.emplace_back(
          read_rigid(table, static_cast<Shape>(*index), scene.sensor, read, trajectory));
    table.finish();
    scene.trajectories.resize(scene.contacts.size());
    if (!trajectory.empty()) scene.trajectories.back() = std::move(trajectory);
  }
}

}  // namespace tactile_net
