/// @file
/// What the command line says of the circuit, over the scene.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "commands/input.hpp"
#include "streams.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {

struct NetworkOptions {
  std::optional<Realization> realization{};  ///< absent: the scene's
  std::optional<double> bandwidth{};         ///< of the op-amps [Hz]; absent: the scene's

  [[nodiscard]] bool any() const noexcept { return realization || bandwidth; }
};

/// @param err  told if the bandwidth changes nothing
/// @throw WrongUsage  the bandwidth is out of range
void apply(const NetworkOptions& network, tactile_net::NetworkOptions& of_scene, std::ostream& err);

/// A scene of a line or a skin, its circuit as the command line says.
/// @throw InputError, WrongUsage
[[nodiscard]] AnyScene circuit_scene(const InputText& text, const NetworkOptions& network,
                                     const Streams& streams);
[[nodiscard]] AnyScene read_circuit_scene(const std::string& path, const NetworkOptions& network,
                                          const Streams& streams);

}  // namespace tactile_net::tool
