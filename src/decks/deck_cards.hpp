/// @file
/// A deck's text, cut into cards: what stands on a line and on those that continue it. Private.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::decks {

/// One statement of a deck, in lower case, without comments.
struct DeckCard {
  std::size_t line = 0;    ///< where it begins, from 1
  std::size_t column = 1;  ///< of its first character, from 1
  std::string text{};      ///< begins with a letter or a dot; continuations joined by blanks
};

/// A line that no simulator reads: what follows its asterisk.
struct DeckComment {
  std::size_t line = 0;
  std::string text{};
};

struct DeckText {
  std::vector<DeckCard> cards{};  ///< up to `.end`, which is left out, as the title is
  std::vector<DeckComment> comments{};
};

/// What the first line of a file is.
enum class FirstLine { title, card };

/// @param file  for messages
/// Commands to ngspice behind `.end` (`.control` to `.endc`), such as print the answer, are left
/// out.
///
/// @throw InputError  a line that is neither card, comment nor continuation; a card behind `.end`;
///                    a character that no card needs: quotes, `$`, backslashes, control characters;
///                    a first line that would make ngspice take the deck for a script
[[nodiscard]] DeckText deck_cards(std::string_view text, const std::string& file,
                                  FirstLine first = FirstLine::title);

}  // namespace tactile_net::decks
