/// @file
/// A circuit as a SPICE deck.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/network/circuit.hpp"

namespace tactile_net {

struct DeckHeader {
  std::string title{};                  ///< line 1, one line
  std::vector<std::string> comments{};  ///< what the deck solves and its scale; one line each
  std::vector<double> expected{};       ///< voltage of each output [V]; empty: not known
};

/// Who prints the answer.
enum class Answer {
  raw_file,  ///< nothing in the deck: run it with `ngspice -b -r FILE`
  printed,   ///< ngspice prints each output with all digits: plain `ngspice -b`
};

/// Writes the deck: title, comments, expected answer (`* expect n0 1.25e-3`), sub-circuits, one
/// card per element in the circuit's order, `.op`, `.end`.
///
/// Pure SPICE: `Answer::printed` adds only lines that begin with `*#`, commands to ngspice and
/// comments to every other simulator. Numbers are the shortest text that reads back as the same
/// double: six digits would cost 4e-3 in the answer at alpha = 1e-6. The caller flushes and checks
/// the stream.
///
/// @throw std::invalid_argument  an element is not finite, a conductance is 0, a node or
///                               sub-circuit does not exist, or the header has a line break; the
///                               stream is then untouched
void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header, Answer answer);

}  // namespace tactile_net
