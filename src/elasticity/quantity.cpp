#include "tactile_net/elasticity/quantity.hpp"

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr Named<Traction> components[] = {{Traction::normal, "normal"},
                                          {Traction::tangential, "tangential"}};
static_assert(traction_components.size() == std::size(components));

}  // namespace

std::string_view name(Quantity quantity) noexcept { return name_in<quantity_traits>(quantity); }

std::optional<Quantity> quantity_named(std::string_view text) noexcept {
  return named_in<quantity_traits>(text);
}

std::string_view name(Traction component) noexcept { return name_in<components>(component); }

bool is_strain(Quantity quantity) noexcept { return row_in<quantity_traits>(quantity).unit == "1"; }

bool is_odd(Quantity quantity, Traction component) noexcept {
  return row_in<quantity_traits>(quantity).odd_for_normal == (component == Traction::normal);
}

}  // namespace tactile_net
