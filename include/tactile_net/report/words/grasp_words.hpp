/// @file
/// A grasp's study as text: cells and sentences that the terminal and the report share.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::report {

using Cells = std::vector<std::vector<std::string>>;

/// One row per finger: the force at its contact, its friction, and whether it holds.
[[nodiscard]] Cells contact_cells(const lab::GraspStudy& study,
                                  const std::vector<FingerAction>& actions,
                                  const std::vector<lab::FingerMargins>& margins);

/// One row per joint: its torque, and what is left to its limit.
[[nodiscard]] Cells torque_cells(const lab::GraspStudy& study,
                                 const std::vector<FingerAction>& actions,
                                 const std::vector<lab::FingerMargins>& margins);

/// "load (0, -10) at (0, 0.08), torque 0"; "no load".
[[nodiscard]] std::string load_in_words(const lab::GraspStudy& study);

/// Where each finger's contact comes from.
[[nodiscard]] std::vector<std::string> sources_in_words(const lab::GraspStudy& study);

/// How well the measured forces carry the load, and how they squeeze.
[[nodiscard]] std::vector<std::string> balance_in_words(const lab::GraspStudy& study);

/// What was held: by which squeeze, and what is least.
[[nodiscard]] std::vector<std::string> hold_in_words(const lab::GraspStudy& study);

void print_grasp(std::ostream& out, const lab::GraspStudy& study);

}  // namespace tactile_net::report
