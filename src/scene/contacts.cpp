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
constexpr std::size_t tractions = 3;

constexpr auto rigid_keys = {"center", "half_width", "force", "friction"};
constexpr auto sampled_keys = {"normal", "tangential"};

/// Width of the surface that belongs to the taxels; 0: not known.
double width(const SensorArray& array) { return static_cast<double>(array.count) * array.pitch; }

/// Both in lengths; the slack lets a contact be exactly as wide as the array in decimal fractions.
bool exceeds(double length, double limit) { return length > limit * (1.0 + 1e-12); }

RigidContact read_rigid(Table& table, Shape shape, const SensorArray& array) {
  RigidContact contact;
  contact.shape = shape;
  const auto center = table.value("center");
  const auto half_width = table.required(
      "half_width", "half the width of the loaded strip, in the unit of pitch: half_width = 2.0");
  const auto force = table.required("force", "the load per unit length out of plane: force = 1.0");
  const auto friction = table.value("friction");

  // What is wrong counts as harmless below: a centre of 0, a half width of 0.
  if (center) contact.center = center->number(any_number).value_or(0.0);
  contact.half_width = half_width ? half_width->number(positive).value_or(0.0) : 0.0;
  if (force) contact.force = force->number(not_negative).value_or(contact.force);
  if (friction) contact.friction = friction->number(any_number).value_or(contact.friction);

  if (shape == Shape::punch) {
    if (const auto edge = table.value("edge"))
      contact.edge = edge->number(not_negative).value_or(contact.edge);
  } else {
    table.not_here("edge", "applies to the shape \"punch\" only", "remove it");
  }
  for (const std::string_view key : sampled_keys)
    table.not_here(key, "applies to the shape \"tractions\" only",
                   "remove it, or give the load by shape = \"tractions\"");

  const double all = width(array);
  if (contact.half_width == 0.0 || all == 0.0) return contact;
  if (exceeds(2.0 * contact.half_width, all))
    half_width->misfit("makes the contact wider than the array (count * pitch)",
                       "a smaller half_width, or more taxels");
  else if (center && std::abs(contact.center) - contact.half_width >= all / 2.0)
    center->misfit("puts the contact beside the array, which is centred on 0",
                   "move it, or give the array more taxels");
  return contact;
}

void check_size(const std::optional<Value>& value, const std::vector<double>& numbers,
                const SensorArray& array) {
  if (array.count == 0 || numbers.size() == array.count) return;
  value->problem("must have one value per taxel: " + std::to_string(array.count) + " (got " +
                 std::to_string(numbers.size()) + ')');
}

SampledTractions read_tractions(Table& table, const SensorArray& array) {
  SampledTractions contact;
  contact.pitch = array.pitch;
  if (array.count > 0) contact.first = -0.5 * static_cast<double>(array.count - 1) * array.pitch;
  const auto normal = table.required(
      "normal", "the normal traction at every taxel, from the lowest y: normal = [0.0, 0.5, 0.0]");
  const auto tangential = table.value("tangential");
  if (normal) {
    if (auto numbers = normal->numbers(any_number)) {
      check_size(normal, *numbers, array);
      contact.normal = std::move(*numbers);
    }
  }
  if (tangential) {
    if (auto numbers = tangential->numbers(any_number)) {
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
void pass_over(Table& table) {
  for (const std::string_view key : rigid_keys) (void)table.value(key);
  for (const std::string_view key : sampled_keys) (void)table.value(key);
  (void)table.value("edge");
}

}  // namespace

std::vector<Contact> read_contacts(std::vector<Table> tables, const SensorArray& array) {
  std::vector<Contact> contacts;
  for (Table& table : tables) {
    const auto shape = table.required(
        "shape", "how the load is spread: \"cylinder\", \"punch\", \"wedge\" or \"tractions\"");
    const auto index = shape ? shape->one_of("shape", shape_names) : std::nullopt;
    if (!index)
      pass_over(table);
    else if (*index == tractions)
      contacts.emplace_back(read_tractions(table, array));
    else
      contacts.emplace_back(read_rigid(table, static_cast<Shape>(*index), array));
    table.finish();
  }
  return contacts;
}

}  // namespace tactile_net
