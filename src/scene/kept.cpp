#include "tactile_net/scene/kept.hpp"

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr Named<Kept> kept_values[] = {{Kept::alpha, "alpha"},
                                       {Kept::error, "error"},
                                       {Kept::error_tangential, "error_tangential"},
                                       {Kept::mean_error, "mean_error"},
                                       {Kept::force, "force"},
                                       {Kept::tangential_force, "tangential_force"},
                                       {Kept::centre_y, "centre_y"},
                                       {Kept::centre_z, "centre_z"},
                                       {Kept::condition, "condition"},
                                       {Kept::error_bound, "error_bound"},
                                       {Kept::readings, "readings"},
                                       {Kept::truth, "truth"},
                                       {Kept::tractions, "tractions"}};

}  // namespace

std::string_view name(Kept kept) noexcept { return name_in<kept_values>(kept); }

std::optional<Kept> kept_named(std::string_view name) noexcept {
  return named_in<kept_values>(name);
}

std::vector<std::string_view> kept_names() {
  std::vector<std::string_view> names;
  for (const auto& row : kept_values) names.push_back(row.name);
  return names;
}

}  // namespace tactile_net
