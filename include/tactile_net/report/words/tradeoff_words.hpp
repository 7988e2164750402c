/// @file
/// A study of work and precision in words.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/study/study.hpp"
#include "tactile_net/study/work_precision.hpp"

namespace tactile_net::report {

/// What a user has to know first, a sentence each: recommendations and where a circuit is faster.
[[nodiscard]] std::vector<std::string> in_words(const study::Study& study);

/// The circuits of op-amps of 10 MHz as rows, the fastest first; under their headings, which stand
/// alone where none was simulated:
///
///     circuit                   the realisation's name
///     settles to 1 %            how long it takes
///     beats a clock below       a controller that needs as many cycles as this machine is slower
///                               than the circuit if its clock is slower than this
///     beats this machine from   the op-amps' bandwidth from which it is faster than this machine
///     parts of 1 % leave        its median error with parts within 1 % of their values
[[nodiscard]] std::vector<std::vector<std::string>> circuit_cells(const study::Study& study);

/// Of a skin: what a frame takes on arrays of other sizes, as rows, under their headings, which
/// stand alone where none was timed. Circuits are two arrays of op-amps of 10 MHz with one cell a
/// taxel, to 1 %.
[[nodiscard]] std::vector<std::vector<std::string>> size_cells(const study::Study& study);

/// Of a skin: whether 16 x 16 and 32 x 32 such taxels keep up with a loop of 1 kHz, and from which
/// array on a circuit is faster than this machine. Empty where no array of another size was timed.
[[nodiscard]] std::vector<std::string> sizes_in_words(const study::Study& study);

/// "lattice", "a loop of 1 kHz".
[[nodiscard]] std::string in_words(const study::Follower& follower);

/// How circuits of op-amps of 10 MHz and sampled loops follow contacts that move, as rows; the
/// headings stand alone where nothing moves:
///
///     follower               the realisation's name, or "a loop of 1 kHz"
///     behind                 the circuit's delay; of a loop the mean
///     1 % of the answer at   that speed
///     nearer from            the speed from which the circuit, of parts of 1 %, errs less than a
///                            loop of 1 kHz that computes the exact answer, then of 10 kHz
[[nodiscard]] std::vector<std::vector<std::string>> moving_cells(const study::Study& study);

/// The same as a sentence of the circuit that bears its parts best; empty: nothing moves, or there
/// is none.
[[nodiscard]] std::string moving_in_words(const study::Study& study);

/// The points that nothing beats, fastest first.
[[nodiscard]] std::vector<std::vector<std::string>> front_cells(const study::Study& study);

/// What did not work, and why.
[[nodiscard]] std::vector<std::string> failures_in_words(const study::Study& study);

/// The answer to a demand, with its margins.
[[nodiscard]] std::string answer(const study::Study& study, const study::Requirement& requirement);

}  // namespace tactile_net::report
