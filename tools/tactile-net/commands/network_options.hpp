/// @file
/// What the command line says of the circuit, over the scene.
#pragma once

#include <iosfwd>
#include <optional>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::tool {

struct NetworkOptions {
  std::optional<Realization> realization{};  ///< absent: the scene's
  std::optional<double> bandwidth{};         ///< of the op-amps [Hz]; absent: the scene's

  [[nodiscard]] bool any() const noexcept { return realization || bandwidth; }
};

/// @param err  told if the bandwidth changes nothing
/// @throw WrongUsage  the bandwidth is out of range
void apply(const NetworkOptions& network, Scene& scene, std::ostream& err);

}  // namespace tactile_net::tool
