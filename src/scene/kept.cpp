#include "tactile_net/scene/kept.hpp"

#include "numeric/named.hpp"

namespace tactile_net {
std::string_view name(Kept kept) noexcept { return name_in<Enumerators<Kept>::all>(kept); }

std::optional<Kept> kept_named(std::string_view name) noexcept {
  return named_in<Enumerators<Kept>::all>(name);
}

std::vector<std::string_view> kept_names() {
  std::vector<std::string_view> names;
  for (const auto& row : Enumerators<Kept>::all) names.push_back(row.name);
  return names;
}

}  // namespace tactile_net
