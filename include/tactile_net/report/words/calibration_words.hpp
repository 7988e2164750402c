/// @file
/// A calibration as text.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/calibrate.hpp"
#include "tactile_net/report/words/answers.hpp"

namespace tactile_net::report {

/// Header and rows: parameter, nominal, found, verdict.
[[nodiscard]] std::vector<std::vector<std::string>> calibration_cells(
    const lab::SceneCalibration& found);

/// "41 taxels, pitch 0.5 mm, reading stress_x at depth 1.4 mm; layer ...": what was calibrated.
[[nodiscard]] std::string calibrated_in_words(const lab::SceneCalibration& found);

/// What cannot be told apart, and what would end it: a sentence each.
[[nodiscard]] std::string in_words(const lab::SceneCalibration& found,
                                   const NullDirection& direction);
[[nodiscard]] std::vector<std::string> null_directions_in_words(const lab::SceneCalibration& found);

/// Whether the fit holds, what stands out, and what was put aside.
[[nodiscard]] std::vector<std::string> calibration_in_words(const lab::SceneCalibration& found);

/// Header and rows of the presses to do next; and how to read them, or empty where none is planned.
[[nodiscard]] std::vector<std::vector<std::string>> next_press_cells(
    const lab::SceneCalibration& found);
[[nodiscard]] std::string next_presses_in_words(const lab::SceneCalibration& found);

/// Whether it may be used, the depth, the gains, and what stays unknown.
[[nodiscard]] std::vector<Answer> answers(const lab::SceneCalibration& found);

void print_calibration(std::ostream& out, const lab::SceneCalibration& found);

}  // namespace tactile_net::report
