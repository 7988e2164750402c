/// @file
/// How large a circuit a deck's sub-circuits make. Private.
#pragma once

#include <string>

#include "decks/deck_cards.hpp"

namespace tactile_net::decks {

/// Ten lines of sub-circuits that each contain ten of the one before are ten thousand million
/// elements: the deck is small, what it asks for is not.
///
/// @throw InputError  a sub-circuit that contains itself, is not in the deck, is not closed; more
///                    than ten million elements
double check_size(const DeckText& deck, const std::string& file);

}  // namespace tactile_net::decks
