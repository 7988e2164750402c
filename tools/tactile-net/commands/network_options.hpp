/// @file
/// What the command line says of the circuit, over the scene.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::tool {

struct NetworkOptions {
  std::string realization{};          ///< empty: the scene's
  std::optional<double> bandwidth{};  ///< of the op-amps [Hz]; absent: the scene's

  [[nodiscard]] bool any() const noexcept { return !realization.empty() || bandwidth; }
};

/// @param err  told if the bandwidth changes nothing
/// @throw WrongUsage  no realisation has that name, or the bandwidth is out of range
void apply(const NetworkOptions& network, Scene& scene, std::ostream& err);

}  // namespace tactile_net::tool
