/// @file
/// A vendor's macromodel of an op-amp in place of ours.
///
///     const Macromodel model = read_macromodel("ths4551.lib", options, "THS4551", outputs);
///     MacromodelSimulator simulator(ngspice, model, circuit);   // ngspice: with
///     NgspiceOptions::pspice simulator.run(deck_of_that_circuit);
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/network/circuit.hpp"
#include "tactile_net/scene/macromodel.hpp"
#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::decks {

/// A file's cards, checked: they reach the simulator, and nothing else of the file does.
struct Macromodel {
  std::string file{};
  std::string name{};                            ///< of the sub-circuit that stands for an op-amp
  std::vector<MacromodelPin> pins{};             ///< what each of its pins is for, in its order
  double supply = 0.0;                           ///< between the supply pins [V]
  double board_input = 0.0, board_output = 0.0;  ///< capacitance to ground that a board adds [F]
  std::string text{};                            ///< the cards, a line each
  double elements = 0.0;                         ///< of one, those of sub-circuits included
};

/// Reads a macromodel. A stranger's file is a program: `.subckt`, `.ends`, `.model`, `.param`,
/// `.func` and elements that open no file are taken (docs/strangers.md).
///
/// @param options  which sub-circuit it is, what its pins are for, its supply [V]
/// @param part     the op-amp's name, which a sub-circuit that is not named may begin with
/// @param supply   between the supply pins where `options` states none [V]; > 0
/// @throw InputError  the file cannot be read, is larger than 4 MiB or encrypted; a card that is
///                    not taken; no sub-circuit, or several; other pins than the outputs ask for
[[nodiscard]] Macromodel read_macromodel(const std::string& path, const MacromodelOptions& options,
                                         std::string_view part, Outputs outputs, double supply);

/// Runs decks of a circuit with the macromodel where its amplifiers stand, each with a supply of
/// its own.
class MacromodelSimulator final : public Simulator {
 public:
  /// @param simulator  must outlive the object
  /// @throw InputError  the circuit would have more than a million elements, or has a sub-circuit
  ///                    of a name that the file has
  MacromodelSimulator(Simulator& simulator, const Macromodel& model, const Circuit& circuit);
  /// @throw SimulatorError         as of the simulator
  /// @throw std::invalid_argument  the deck has none of the circuit's amplifiers
  [[nodiscard]] Simulation run(const std::string& deck) override;

 private:
  Simulator* simulator_;
  std::vector<std::pair<std::string, std::string>> replaced_;  // of a deck: what by what
  std::string library_;
};

}  // namespace tactile_net::decks
