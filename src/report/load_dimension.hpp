/// @file
/// Private. What a load is: of a line a force over its depth, of a skin a force at a point.
#pragma once

#include <variant>

#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::report {

[[nodiscard]] constexpr Dimension load_dimension(bool of_skin) noexcept {
  return of_skin ? Dimension::point_force : Dimension::force;
}
[[nodiscard]] inline Dimension load_dimension(const Scene&) { return load_dimension(false); }
[[nodiscard]] inline Dimension load_dimension(const SkinScene&) { return load_dimension(true); }
[[nodiscard]] inline Dimension load_dimension(const AnyScene& scene) {
  return std::visit([](const auto& one) { return load_dimension(one); }, scene);
}

}  // namespace tactile_net::report
