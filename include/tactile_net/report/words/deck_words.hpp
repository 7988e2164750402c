/// @file
/// A scene's circuit as a deck that says what it solves.
#pragma once

#include <string>

#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/simulated_refinement.hpp"
#include "tactile_net/network/dialect.hpp"

namespace tactile_net::report {

/// The deck of the operating point, or of the one frequency of a lossless circuit: with what it
/// solves, its scale, and the voltages to expect. With `Answer::printed` also how far they may be
/// off, so that `relax` can check a deck on disk.
[[nodiscard]] std::string deck_text(const lab::SceneCircuit& circuit, tactile_net::Answer answer,
                                    Dialect dialect = Dialect::ngspice);

/// The same circuit of the parts that a list of its own realisation chose, `own_parts_list`.
/// @pre  there is a choice
[[nodiscard]] std::string deck_text(const lab::SceneCircuit& circuit, const lab::PartsList& list,
                                    Dialect dialect = Dialect::ngspice);

/// A build as it answers in a cycle of a refinement, with the voltages that it comes to.
[[nodiscard]] std::string deck_text(const lab::SceneCircuit& circuit,
                                    const lab::RefinementDeck& cycle,
                                    Dialect dialect = Dialect::ngspice);

/// The circuit as a sub-circuit with pins for the readings' currents, and its symbol for LTspice.
/// @param list  null: exact values, or those of the scene's series
[[nodiscard]] std::string subcircuit_text(const lab::SceneCircuit& circuit,
                                          const lab::PartsList* list, const std::string& name,
                                          Dialect dialect);
[[nodiscard]] std::string symbol_text(const lab::SceneCircuit& circuit, const lab::PartsList* list,
                                      const std::string& name, const std::string& file);

}  // namespace tactile_net::report
