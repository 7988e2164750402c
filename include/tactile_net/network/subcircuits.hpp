/// @file
/// The sub-circuits of the folder `circuits/`, compiled in, so that every deck is complete.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace tactile_net {

struct Subcircuit {
  std::string_view name;      ///< as in its .subckt line
  std::string_view text;      ///< the whole file `circuits/<name>.lib`, ends with a newline
  std::size_t pins = 0;       ///< of its .subckt line
  std::size_t opamps = 0;     ///< inside, nested sub-circuits included
  std::size_t resistors = 0;  ///< inside, nested sub-circuits included
  std::string_view needs;     ///< name of the sub-circuit it instantiates, or empty
};

/// Every sub-circuit, sorted by name.
[[nodiscard]] std::span<const Subcircuit> subcircuits() noexcept;

/// @throw std::invalid_argument  there is no sub-circuit of that name
[[nodiscard]] const Subcircuit& subcircuit(std::string_view name);

}  // namespace tactile_net
