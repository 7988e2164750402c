/// @file
/// What a study keeps of every point, beside what says which point it is and what became of it.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace tactile_net {

/// In the order of the columns.
enum class Kept {
  alpha,
  error,
  error_tangential,
  mean_error,
  force,
  tangential_force,
  centre_y,
  centre_z,
  condition,
  error_bound,
  readings,  ///< lists of numbers from here on
  truth,
  tractions
};

/// "alpha", "error", ...: also the column's name.
[[nodiscard]] std::string_view name(Kept kept) noexcept;
[[nodiscard]] std::optional<Kept> kept_named(std::string_view name) noexcept;

/// The names of all, in their order.
[[nodiscard]] std::vector<std::string_view> kept_names();

/// Of a study that does not say.
[[nodiscard]] inline std::vector<Kept> kept_by_default() {
  return {Kept::alpha, Kept::error,     Kept::error_tangential, Kept::mean_error,
          Kept::force, Kept::condition, Kept::error_bound};
}

}  // namespace tactile_net
