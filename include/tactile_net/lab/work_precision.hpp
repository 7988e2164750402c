/// @file
/// What accuracy costs in time: measured points, which of them nothing else beats, and which to
/// choose.
///
/// Two errors, never to be confused: against the truth (what a user wants to know; regularisation
/// and noise set its floor, whatever the arithmetic), and against the exact solution of the same
/// regularised problem (what an algorithm or a circuit adds to that).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::lab {

/// What a point's time is.
enum class TimeOf {
  frame,      ///< a frame's arithmetic, on this machine
  settling,   ///< a circuit's answer to a step, as simulated in ngspice
  simulator,  ///< ngspice's own wall time for one frame: not the circuit's
  forward,    ///< the forward model's arithmetic: readings of known tractions
};

[[nodiscard]] std::string_view name(TimeOf time_of) noexcept;

struct WorkPoint {
  std::string curve{};  ///< the method: points of one curve differ in their knob
  std::string knob{};   ///< "rank 24 + 23", "4 steps", "10 MHz"
  TimeOf time_of = TimeOf::frame;
  double seconds = 0.0;      ///< median
  double seconds_low = 0.0;  ///< quartiles
  double seconds_high = 0.0;
  std::optional<double> error_to_solution{};  ///< |f - f*|_2 / |f*|_2; absent: another problem
  std::optional<double> error_to_truth{};     ///< |f - truth|_2 / |truth|_2; absent: no contact
  std::string failure{};                      ///< why there is no point; empty: there is one

  [[nodiscard]] bool measured() const noexcept { return failure.empty(); }
};

/// Which error of a point a question is about.
using ErrorOf = std::optional<double> WorkPoint::*;

/// Indices of the points that no other of the same `time_of` beats in both time and error, fastest
/// first. Points without that error are left out.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const WorkPoint> points,
                                                    ErrorOf error, TimeOf time_of);

/// What a user must have; absent: no demand.
struct Requirement {
  std::optional<double> accuracy{};  ///< of `ErrorOf`, > 0
  std::optional<double> deadline{};  ///< [s], > 0
};

/// The answer to a requirement.
struct Choice {
  std::optional<std::size_t> point{};          ///< the fastest that meets both; absent: none does
  std::optional<std::size_t> fastest{};        ///< of those accurate enough; absent: none is
  std::optional<std::size_t> most_accurate{};  ///< of those in time; absent: none is
};

/// @throw std::invalid_argument  a demand is not > 0 and finite
[[nodiscard]] Choice choose(std::span<const WorkPoint> points, ErrorOf error, TimeOf time_of,
                            const Requirement& requirement);

}  // namespace tactile_net::lab
