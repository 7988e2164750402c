/// @file
/// A scene's circuit as a deck that says what it solves.
#pragma once

#include <string>

#include "tactile_net/lab/scene_circuit.hpp"

namespace tactile_net::report {

/// The deck of the operating point, or of the one frequency of a lossless circuit: with what it
/// solves, its scale, and the voltages to expect. With `Answer::printed` also how far they may be
/// off, so that `relax` can check a deck on disk.
[[nodiscard]] std::string deck_text(const lab::SceneCircuit& circuit, tactile_net::Answer answer);

}  // namespace tactile_net::report
