/// @file
/// A scene's file again, with the circuit that is to be ordered in place of its own.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tactile_net/scene/reader.hpp"

namespace tactile_net {

/// What a list of parts and its board have chosen.
struct OrderedCircuit {
  Realization realization = Realization::lattice;
  bool ladder = false;
  std::optional<double> siemens{};  ///< in the scene's unit; absent: the scene's own
};

/// [network] states the realisation, the ladder and the siemens, where they stand or in lines of
/// its own; everything else, comments too, stays byte for byte. A scene that names other files says
/// in its first line where it belongs, since names are relative to its folder.
///
/// @param toml   the text that `scene` was read from
/// @param by     the command that has chosen, for a comment; empty: none
/// @throw std::invalid_argument  [network] is written in a way that leaves no line for a key
/// @throw InputError  the text is not that of a scene
[[nodiscard]] std::string ordered_scene(std::string_view toml, const AnyScene& scene,
                                        const OrderedCircuit& ordered, std::string_view by);

/// "board.ordered.toml" of "scenes/circuits/board.toml".
[[nodiscard]] std::string ordered_scene_file(const std::string& scene);

}  // namespace tactile_net
