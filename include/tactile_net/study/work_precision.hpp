/// @file
/// What accuracy costs in time: which points nothing else beats, and which to choose.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/study/work_point.hpp"

namespace tactile_net::study {

/// Which error of a point a question is about.
using ErrorOf = std::optional<double> WorkPoint::*;
inline constexpr ErrorOf to_solution = &WorkPoint::error_to_solution;
inline constexpr ErrorOf to_truth = &WorkPoint::error_to_truth;

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

/// The shortest time of a frame within one percent of the exact solution [s]; absent: no point is.
[[nodiscard]] std::optional<double> fastest_frame(std::span<const WorkPoint> points);

}  // namespace tactile_net::study
