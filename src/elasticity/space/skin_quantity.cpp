#include "tactile_net/elasticity/space/skin_quantity.hpp"

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr Named<SkinTraction> skin_components[] = {{SkinTraction::normal, "normal"},
                                                   {SkinTraction::tangential_y, "tangential_y"},
                                                   {SkinTraction::tangential_z, "tangential_z"}};
static_assert(skin_tractions.size() == std::size(skin_components));
static_assert(axis(SkinTraction::normal) == Axis::x &&
              axis(SkinTraction::tangential_y) == Axis::y &&
              axis(SkinTraction::tangential_z) == Axis::z);

}  // namespace

std::string_view name(SkinQuantity quantity) noexcept {
  return name_in<skin_quantity_traits>(quantity);
}

std::optional<SkinQuantity> skin_quantity_named(std::string_view text) noexcept {
  return named_in<skin_quantity_traits>(text);
}

std::string_view name(SkinTraction component) noexcept {
  return name_in<skin_components>(component);
}

}  // namespace tactile_net
