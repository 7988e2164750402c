#include "tactile_net/elasticity/quantity.hpp"

#include <stdexcept>
#include <string>

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr Named<Traction> components[] = {{Traction::normal, "normal"},
                                          {Traction::tangential_y, "tangential_y"},
                                          {Traction::tangential_z, "tangential_z"}};
static_assert(skin_tractions.size() == std::size(components));
static_assert(axis(Traction::normal) == Axis::x && axis(Traction::tangential_y) == Axis::y &&
              axis(Traction::tangential_z) == Axis::z);

template <class Value>
bool contains(std::span<const Value> values, Value value) noexcept {
  return std::find(values.begin(), values.end(), value) != values.end();
}

}  // namespace

std::string_view name(Quantity quantity) noexcept { return name_in<quantity_traits>(quantity); }

std::optional<Quantity> quantity_named(std::string_view text,
                                       std::span<const Quantity> among) noexcept {
  const auto found = named_in<quantity_traits>(text);
  return found && contains(among, *found) ? found : std::nullopt;
}

std::string_view name(Traction component) noexcept { return name_in<components>(component); }

std::string_view line_name(Traction component) noexcept {
  return component == Traction::tangential_y ? "tangential" : name(component);
}

void check_line(Quantity quantity) {
  if (contains<Quantity>(line_quantities, quantity)) return;
  std::string names;
  for (const Quantity one : line_quantities)
    names += (names.empty() ? "" : ", ") + std::string(name(one));
  throw std::invalid_argument("a line array cannot read " + std::string(name(quantity)) +
                              ": name quantities out of " + names + ", or use a skin");
}

void check_line(Traction component) {
  if (contains<Traction>(line_tractions, component)) return;
  throw std::invalid_argument("a line's load has no " + std::string(name(component)) +
                              " traction: name normal or tangential_y, or use a skin");
}

Quantity exchanged(Quantity quantity) noexcept {
  const QuantityTraits& of = traits(quantity);
  const Axis first = exchanged(of.first);
  const Axis second = exchanged(of.second);
  const auto is_it = [&](const QuantityTraits& row) {
    return row.kind == of.kind && ((row.first == first && row.second == second) ||
                                   (row.first == second && row.second == first));
  };
  return std::find_if(quantity_traits.begin(), quantity_traits.end(), is_it)->value;
}

}  // namespace tactile_net
