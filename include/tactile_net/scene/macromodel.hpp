/// @file
/// How a vendor's macromodel of an op-amp stands in a circuit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

/// What a pin of a macromodel is for.
enum class MacromodelPin {
  in_plus,
  in_minus,
  out,
  out_plus,
  out_minus,
  supply_plus,
  supply_minus,
  common_mode,
  power_down,
  ground,
  open
};

template <>
struct Enumerators<MacromodelPin> {
  static constexpr Enumerator<MacromodelPin> all[] = {
      {MacromodelPin::in_plus, "in_plus", "The input that is not inverted."},
      {MacromodelPin::in_minus, "in_minus", "The input that is inverted."},
      {MacromodelPin::out, "out", "The output of an op-amp that has one."},
      {MacromodelPin::out_plus, "out_plus", "Of two outputs the one that follows in_plus."},
      {MacromodelPin::out_minus, "out_minus", "Of two outputs the other."},
      {MacromodelPin::supply_plus, "supply_plus", "The positive supply."},
      {MacromodelPin::supply_minus, "supply_minus", "The negative supply."},
      {MacromodelPin::common_mode, "common_mode", "What the outputs' mean follows: at 0 V here."},
      {MacromodelPin::power_down, "power_down", "Works while high: at the positive supply here."},
      {MacromodelPin::ground, "ground", "At 0 V."},
      {MacromodelPin::open, "open", "At nothing, but 1 teraohm to 0 V."}};
};

struct MacromodelOptions {
  std::string name{};                 ///< of its sub-circuit; empty: the part's, or the only one
  std::vector<MacromodelPin> pins{};  ///< what each is for, in its order; empty: the usual order
  std::optional<double> supply{};     ///< between its supply pins [V]; absent: the op-amp's
  /// What `parasitic` adds at every op-amp's inputs and outputs [F], which no macromodel has.
  double board_input = 0.0, board_output = 0.0;
};

}  // namespace tactile_net
