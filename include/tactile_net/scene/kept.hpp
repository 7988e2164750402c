/// @file
/// What a study keeps of every point, beside what says which point it is and what became of it.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/fields.hpp"

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

template <>
struct Enumerators<Kept> {
  static constexpr Enumerator<Kept> all[] = {
      {Kept::alpha, "alpha", "The regularisation."},
      {Kept::error, "error", "|f - truth|_2 / |truth|_2."},
      {Kept::error_tangential, "error_tangential", "The same of the tangential traction."},
      {Kept::mean_error, "mean_error", "The mean of |f - truth|."},
      {Kept::force, "force", "The normal force."},
      {Kept::tangential_force, "tangential_force", "The tangential force."},
      {Kept::centre_y, "centre_y", "The force's centre, along y."},
      {Kept::centre_z, "centre_z", "The force's centre, along z."},
      {Kept::condition, "condition", "The condition number."},
      {Kept::error_bound, "error_bound", "What rounding may have done, relative."},
      {Kept::readings, "readings", "Every reading."},
      {Kept::truth, "truth", "Every traction of the contacts."},
      {Kept::tractions, "tractions", "Every traction found."}};
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
