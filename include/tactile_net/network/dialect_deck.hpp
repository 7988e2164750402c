/// @file
/// Decks of parts that are sold, for other simulators too, and circuits as sub-circuits.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/dialect.hpp"
#include "tactile_net/network/part_values.hpp"

namespace tactile_net {

struct DeckForm {
  Dialect dialect = Dialect::ngspice;
  /// Of every resistor, as it is sold: its value, and its tolerance as a comment; empty: the
  /// circuit's own values.
  std::span<const SoldPart> parts{};
};

/// As `write_deck` of deck.hpp, in that form. `Answer::printed` is for ngspice; for Xyce there is
/// always `.print`, without which it has no answer, and LTspice shows an operating point unasked.
///
/// Elsewhere than in ngspice a lossless circuit gets 1 milliohm in series with every inductor and 1
/// teraohm from every output to ground, so that it has an operating point.
///
/// @throw std::invalid_argument  as there; there is another number of parts; or the deck is none of
///                               the dialect (`check_dialect`); the stream is then untouched
void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header, Answer answer,
                const Analysis& analysis, const DeckForm& form);

/// Nodes that a circuit as a sub-circuit has as pins: those that its sources lead into, in their
/// order, then its outputs; each once.
[[nodiscard]] std::vector<Node> ports(const Circuit& circuit);

/// Writes the circuit as a sub-circuit without its sources: whoever uses it brings the readings as
/// currents into its first pins. What it is made of is defined inside it.
///
/// @param header  its title is a comment, what it expects is left out
/// @throw std::invalid_argument  as `write_deck`, or the name is no name
void write_subcircuit(std::ostream& out, const Circuit& circuit, const DeckHeader& header,
                      const std::string& name, const DeckForm& form = {});

/// Its symbol for LTspice (.asy): a box, readings on the left, outputs on the right.
///
/// @param file  the sub-circuit's, as the symbol is to name it
/// @throw std::invalid_argument  the name is no name, or the file's has a line break
void write_symbol(std::ostream& out, const Circuit& circuit, const std::string& name,
                  const std::string& file);

}  // namespace tactile_net
