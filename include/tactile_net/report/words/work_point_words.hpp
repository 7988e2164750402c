/// @file
/// The words for what a study measured: the labels of its CSV, JSON and page.
///
///     in_words(WorkCurve)  "reflections low rank float64", "nic, 10 MHz"
///     in_words(Knob)       "rank 24 + 23", "settled to 0.01, by its poles"
///     in_words(Job)        "settling, nic"
#pragma once

#include <string>

#include "tactile_net/study/runner.hpp"
#include "tactile_net/study/work_point.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string in_words(const study::Job& job);
[[nodiscard]] std::string in_words(const study::WorkCurve& curve);
/// Empty for a curve of one point.
[[nodiscard]] std::string in_words(const study::Knob& knob);
[[nodiscard]] std::string in_words(const study::Failure& failure);

/// "reflections low rank float64, rank 24 + 23"
[[nodiscard]] std::string in_words(const study::WorkPoint& point);

/// "12 %, settling, nic, about 34 s left"
[[nodiscard]] std::string in_words(const study::StudyProgress& progress);

}  // namespace tactile_net::report
