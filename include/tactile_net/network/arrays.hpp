/// @file
/// Which array of a circuit a resistor belongs to, and where in it: by its name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tactile_net {

enum class Array {
  conductances,  ///< of P: an entry, a branch, a converter's
  kernel,        ///< K
  transposed,    ///< K'
  stabiliser,    ///< R
  feedback,      ///< of residual amplifiers
  ground,        ///< from a node to ground
  inputs,        ///< that readings come in through
  inside,        ///< of a converter or an inverter
};

/// "K", "stabiliser", ...
[[nodiscard]] std::string_view name(Array array) noexcept;

/// Of an entry of P or R, or of a reading (row) and a traction (column).
struct ResistorPlace {
  Array array = Array::conductances;
  std::size_t row = 0;
  std::size_t column = 0;  ///< the row, where there is but one number
};

/// @param resistor  as realisations name them: "Rk0_1p", "Re3", "R1.Xf0_1"
[[nodiscard]] ResistorPlace place_of(std::string_view resistor);

/// The resistor that stands for the same entry of K, of one that stands for an entry of K'; empty:
/// it does not.
[[nodiscard]] std::string same_entry(std::string_view resistor);

}  // namespace tactile_net
