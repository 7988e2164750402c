#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

std::string_view name(Quantity quantity) noexcept {
  switch (quantity) {
    case Quantity::stress_x:
      return "stress_x";
    case Quantity::stress_y:
      return "stress_y";
    case Quantity::shear_xy:
      return "shear_xy";
    case Quantity::strain_x:
      return "strain_x";
    case Quantity::strain_y:
      return "strain_y";
  }
  return "";
}

std::optional<Quantity> quantity_named(std::string_view text) noexcept {
  for (const Quantity quantity : quantities)
    if (name(quantity) == text) return quantity;
  return std::nullopt;
}

bool is_strain(Quantity quantity) noexcept {
  return quantity == Quantity::strain_x || quantity == Quantity::strain_y;
}

bool is_odd(Quantity quantity, Traction component) noexcept {
  return (quantity == Quantity::shear_xy) == (component == Traction::normal);
}

}  // namespace tactile_net
