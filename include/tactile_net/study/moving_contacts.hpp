/// @file
/// How far behind contacts that move circuits and loops are, as errors of the answer.
#pragma once

#include <optional>
#include <vector>

#include "tactile_net/network/realization.hpp"

namespace tactile_net::study {

/// What follows contacts: a circuit, as by `MotionLag`, or a loop that samples the readings and
/// holds its answer until the next one, with nothing else to wait for.
struct Follower {
  std::optional<Realization> realization{};  ///< absent: a loop
  double sampling_hertz = 0.0;               ///< of a loop
  double delay = 0.0;  ///< of a circuit; of a loop the mean, half an interval [s]

  bool operator==(const Follower&) const = default;
};

/// The sampling rates of the loops that circuits are compared with [Hz].
inline constexpr double compared_loops[] = {1e3, 10e3};

/// The exact answer to a frame's contacts, and to those contacts moved along y.
struct MovingContacts {
  std::vector<double> displacements{};  ///< ascending, > 0, in the pitch's unit
  std::vector<double> errors{};         ///< |f*(y) - f*(y - displacement)|_2 / |f*(y)|_2
  std::vector<Follower> followers{};    ///< circuits, then loops

  bool operator==(const MovingContacts&) const = default;
};

/// Of the answer, relative in the 2-norm, behind contacts that move at that speed; of a loop the
/// root mean square over an interval. Linear below the displacements of the table, constant beyond.
///
/// @param speed  > 0, in pitches' units a second
[[nodiscard]] double error_behind(const MovingContacts& contacts, const Follower& follower,
                                  double speed);

/// The speed at which a follower's error is that much, > 0; absent: it never is.
[[nodiscard]] std::optional<double> speed_at_error(const MovingContacts& contacts,
                                                   const Follower& follower, double error);

/// From which speed on a circuit, whose parts leave it `at_rest` off the exact answer, is nearer to
/// the answer than a loop that computes it exactly; absent: never within the table.
[[nodiscard]] std::optional<double> crossover_speed(const MovingContacts& contacts,
                                                    const Follower& circuit, double at_rest,
                                                    const Follower& loop);

/// Speeds that show all of them, half a decade apart, ascending.
[[nodiscard]] std::vector<double> shown_speeds(const MovingContacts& contacts);

}  // namespace tactile_net::study
