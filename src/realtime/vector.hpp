/// @file
/// Vectors of one width, and in which order a panel's columns are summed. Private.
#pragma once

#include <cstddef>

namespace tactile_net {

/// `Bytes` is the width of a vector.
template <class T, int Bytes>
struct Vector {
  typedef T type __attribute__((vector_size(Bytes), may_alias));
  static constexpr std::size_t lanes = Bytes / sizeof(T);
};

/// Column j of a panel of so many vectors is added to sum j mod `panel_sums`; these are added up at
/// the end, in their order. Additions take four cycles and two start in each, so eight must be
/// under way. Whoever multiplies by a panel in another way keeps to this, and gets the same bits.
[[nodiscard]] constexpr std::size_t panel_sums(std::size_t vectors) noexcept {
  return (8 + vectors - 1) / vectors;
}
/// The same of a panel that multiplies two vectors at once.
[[nodiscard]] constexpr std::size_t shared_panel_sums(std::size_t vectors) noexcept {
  return vectors < 4 ? 2 : 1;
}

}  // namespace tactile_net
