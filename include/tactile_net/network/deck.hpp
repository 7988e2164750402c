/// @file
/// A circuit as a SPICE deck.
///
///     const Circuit circuit = realize(Realization::nic, network);     // realization.hpp
///     DeckHeader header{.title = "Five taxels, negative conductances by converters"};
///     write_deck(std::cout, circuit, header, Answer::printed);        // for `ngspice -b`
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/network/circuit.hpp"

namespace tactile_net {

struct DeckHeader {
  std::string title{};                  ///< line 1, one line
  std::vector<std::string> comments{};  ///< what the deck solves and its scale; one line each
  std::vector<double> expected{};       ///< voltage of each output [V]; empty: not known
  std::optional<double> within{};       ///< how far they may be off, in the 2-norm, over their own
};

/// Who prints the answer.
enum class Answer {
  raw_file,  ///< nothing in the deck: run it with `ngspice -b -r FILE`
  printed,   ///< ngspice prints each output with all digits: plain `ngspice -b`
};

/// The operating point: `.op`.
struct DirectCurrent {};

/// One frequency: `.ac`. Every source has its ampere as magnitude, at 90 degrees; the answer is the
/// real part.
struct SingleFrequency {
  double hertz = 0.0;  ///< > 0
};

/// From rest, every source steps from 0 at t = 0: `.tran`, trapezoidal. From the DC solution an
/// unstable circuit would stay there; an implicit method that damps would hide its growth.
struct StepResponse {
  double step = 0.0;  ///< longest time step [s], > 0
  double stop = 0.0;  ///< [s], > step
  /// Test of recovery: until `overdrive_until` [s] the sources are `overdrive` times as large,
  /// which drives amplifiers into their rails; whether they come back is seen afterwards.
  double overdrive = 1.0;
  double overdrive_until = 0.0;
  /// Symmetry breaker: for the first thousandth of the time each source is off by a share of its
  /// own, up to this. Without it a symmetric load never excites the antisymmetric modes, and an
  /// instability there would stay unseen.
  double kick = 0.0;
};

using Analysis = std::variant<DirectCurrent, SingleFrequency, StepResponse>;

/// Writes the deck: title, comments, expected answer (`* expect n0 1.25e-3`, `* within 1e-9`),
/// sub-circuits, one card per element in the circuit's order, the analysis, `.end`.
///
/// Pure SPICE up to `.end`, where every other simulator ceases to read: behind it
/// `Answer::printed` adds commands to ngspice (`.control` ... `.endc`), which print an operating
/// point or the real parts of a single frequency, whatever simulator `ngbehavior` makes it follow.
/// Numbers are the shortest text that reads back as the same double: six digits would cost 4e-3 in
/// the answer at alpha = 1e-6. The caller flushes and checks the stream.
///
/// @throw std::invalid_argument  an element is not finite, a conductance is 0, a node or
///                               sub-circuit does not exist, the header has a line break, or an
///                               analysis is out of range; the stream is then untouched
void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header, Answer answer,
                const Analysis& analysis = DirectCurrent{});

}  // namespace tactile_net
