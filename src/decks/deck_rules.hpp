/// @file
/// Which cards a stranger's deck may have. Private.
#pragma once

#include <string>

#include "decks/deck_cards.hpp"

namespace tactile_net::decks {

/// What a file is to be.
enum class DeckKind {
  deck,        ///< a circuit and one analysis of it
  macromodel,  ///< sub-circuits, and what stands in them
};

/// A deck is a program: cards read files, set the simulator's variables, start processes. What
/// describes a circuit and one analysis of it is taken, in any case of letters: the elements R C L
/// E F G H I V B D X; .subckt, .ends, .param, .ic, .op, .tran, .ac; .model of resistors,
/// capacitors, inductors and diodes; .options that set how equations are solved. Nothing else is.
/// Of a macromodel transistors, switches, lines and couplings too, .func, and neither analysis nor
/// option.
///
/// @throw InputError  another card, at its line, with what to do; sub-circuits that contain
///                    themselves, are not in the deck, or make more than ten million elements
void check_cards(const DeckText& deck, const std::string& file, DeckKind kind = DeckKind::deck);

}  // namespace tactile_net::decks
